# The core as WebAssembly, from the root of the project: make -f web/core.mk
#
# It is the core without what reads or writes files (web/units.c stands in for it) and without one law, the two-dimensional
# field: its line of terms.def and its study are left out, with all that only they need. Without -fno-slp-vectorize,
# clang 14 gives wrong factors of band matrices of a fixed width (src/math/band.c); the tests against the command find that.
rooms := base def math ribbon electro contact liquid paper drive solve actuator device term system rest run study
left_out := src/term/field.c $(addprefix src/electro/,edges_fit.c field.c field_correction.c grid.c) src/math/skyline.c \
  $(addprefix src/study/,profile.c faces.c)
sources := $(filter-out $(left_out),$(sort $(shell find $(addprefix src/,$(rooms)) -name '*.c'))) \
  $(addprefix src/io/,value.c number.c source.c) $(wildcard web/*.c)
objects := $(sources:%.c=web/build/%.o)

CC := clang --target=wasm32-wasi
CFLAGS := -O3 -fno-slp-vectorize -msimd128 -std=c17 -D_GNU_SOURCE -fopenmp-simd -fno-math-errno -ffp-contract=off -DZP_WITHOUT_FIELD \
  -Wall -Wextra -Werror -fvisibility=hidden -Iinclude -Isrc

web/build/zipact.wasm: $(objects)
	@$(CC) -mexec-model=reactor $^ -Wl,--export-dynamic -Wl,--strip-all -Wl,-z,stack-size=1048576 -o $@

web/build/%.o: %.c web/core.mk
	@mkdir -p $(@D)
	@$(CC) $(CFLAGS) -MMD -MP -c -o $@ $<

-include $(objects:.o=.d)
