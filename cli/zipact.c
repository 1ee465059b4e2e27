/* The program zipact: its own threads compute. */
#include "cli.h"

int main(int argc, char **argv) {
  return cli_main(argc, argv, NULL);
}
