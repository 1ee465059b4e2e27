/* Pieces of HTML: escapes, numbers, ids of pictures; where the page of the paper has its pictures. */
#include "check_util.h"

#include "io/file.h"
#include "reproduce/html.h"

static char written[4096];

/* What `put` writes, as text; the last call counts. */
#define WRITTEN(put)                                                                                                   \
  do {                                                                                                                 \
    FILE *file = fmemopen(written, sizeof written, "w");                                                               \
    ck_assert_ptr_nonnull(file);                                                                                       \
    put;                                                                                                               \
    fclose(file);                                                                                                      \
  } while (0)

TEST(test_text_is_escaped) {
  WRITTEN(zp_html_text(file, "a < b & \"c\" > 50 µm"));
  ck_assert_str_eq(written, "a &lt; b &amp; &quot;c&quot; &gt; 50 µm");
}

TESTS(test_numbers, 0, 4) {
  static const char *const pair[][2] = {
      {"12.20", "12.20"}, {"-0.5", "−0.5"}, {"2.4e4", "2.4·10<sup>4</sup>"}, {"-1e-03", "−1·10<sup>−3</sup>"}};
  WRITTEN(zp_html_number(file, pair[_i][0]));
  ck_assert_str_eq(written, pair[_i][1]);
}

TEST(test_ids_of_a_picture_get_a_prefix) {
  FILE *picture = fopen("picture.svg", "w");
  fputs("<?xml version='1.0'?>\n<svg viewBox='0 0 1 1'>\n<title>Gnuplot</title>\n<g id='a'/><use href='#a' "
        "fill=\"url(#b)\"/>\n"
        "</svg>\n",
        picture);
  fclose(picture);
  WRITTEN(ck_assert(zp_html_svg(file, "picture.svg", "p", "a \"b\"")));
  ck_assert_str_eq(written, "<svg role=\"img\" aria-label=\"a &quot;b&quot;\" viewBox='0 0 1 1'>\n"
                            "<g id='p-a'/><use href='#p-a' fill=\"url(#p-b)\"/>\n</svg>\n");
  WRITTEN(ck_assert(!zp_html_svg(file, "no-such-picture.svg", "p", "")));
  remove("picture.svg");
}

/* The page shows pictures of runs that there are, each in the section of its run. */
TEST(pictures_stand_with_their_runs) {
#define ZP_RUN(id, name, weight, scenario) name,
  static const char *const runs[] = {
#include "reproduce/runs.def"
  };
#undef ZP_RUN
  char line[512], section[32] = "", run[32];
  size_t pictures = 0;
  FILE *page = fopen(ZP_SOURCE_DIR "/reproduce/page.html", "r");
  ck_assert_ptr_nonnull(page);
  while (fgets(line, sizeof line, page)) {
    size_t k = 0;
    sscanf(line, "<section id=\"%31[^\"]", section);
    if (sscanf(line, "{{picture runs/%31[^/]", run) != 1) continue;
    while (k < LENGTH_OF(runs) && strcmp(runs[k], run) != 0)
      k++;
    ck_assert_msg(k < LENGTH_OF(runs), "no run is called %s", run);
    ck_assert_msg(strncmp(run, section, strlen(section)) == 0, "%s stands in the section %s", run, section);
    pictures++;
  }
  fclose(page);
  ck_assert_uint_eq(pictures, 7);
}
