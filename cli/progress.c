/* Progress, Ctrl-C and the clock: the hooks of long calls. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"

/* The only object that a signal handler may write. */
static volatile sig_atomic_t interrupted;

static void on_interrupt(int signal_number) {
  interrupted = 1;
  signal(signal_number, SIG_DFL); /* a second one ends the program at once */
}

void cli_watch_interrupts(void) {
  interrupted = 0;
  struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = SA_RESTART};
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
}

bool cli_interrupted(void) {
  return interrupted;
}

double cli_wall_clock(void *unused) {
  (void)unused;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void draw(const char *stage, double fraction) {
  enum { WIDTH = 40 };
  char bar[WIDTH + 1];
  int filled = (int)(fraction * WIDTH);
  for (int i = 0; i < WIDTH; i++)
    bar[i] = i < filled ? '#' : '.';
  bar[WIDTH] = 0;
  fprintf(stderr, "\r[%s] %3.0f %% %-12s", bar, 100 * fraction, stage);
  fflush(stderr);
}

static bool on_progress(void *user, const char *stage, double fraction) {
  static const double between = 0.1; /* s */
  Progress *progress = user;
  if (!progress->shown) return interrupted;
  double now = cli_wall_clock(NULL);
  if (now - progress->last >= between) {
    draw(stage, fraction);
    progress->last = now;
  }
  return interrupted;
}

/* "2:05" or "3:07:09". */
static void print_duration(char *text, size_t size, double seconds) {
  const long s = seconds < 1e7 ? (long)(seconds + 0.5) : 10000000;
  if (s < 3600)
    snprintf(text, size, "%ld:%02ld", s / 60, s % 60);
  else
    snprintf(text, size, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

void cli_draw_campaign(Progress *progress, const ZpCampaignState *state) {
  const double now = cli_wall_clock(NULL), taken = now - progress->start;
  if (!progress->shown) return;
  const double before = (double)state->resumed / (double)state->cases, own = state->fraction - before;
  char rate[32] = "", left[32] = "-";
  if (own > 0 && taken > 0) {
    snprintf(rate, sizeof rate, "%.3g/s", own * (double)state->cases / taken);
    print_duration(left, sizeof left, taken * (1 - state->fraction) / own);
  }
  fprintf(stderr, "\r%zu of %zu  %3.0f %%  %s  %s left  %zu failed%10s", state->done, state->cases,
          100 * state->fraction, rate, left, state->failed, "");
  fflush(stderr);
  progress->last = now;
}

ZpHooks cli_hooks(Progress *progress) {
  return (ZpHooks){.user = progress, .progress = on_progress, .clock = cli_wall_clock};
}

void cli_progress_end(Progress *progress) {
  if (progress->shown && progress->last > 0) fprintf(stderr, "\r%78s\r", "");
}
