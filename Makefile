# make demo    the paper's actuator lifting 8 g at 10 kV, with pictures, in out/demo
# make check   the test suite
# make check-near  those tests that reach what has changed
# make nightly  everything that takes too long for every change; a second call continues where the first one ended
# make weekly   what takes some hours: many random designs, the tests under load, another processor
# make mutants  do the tests notice faults?
# make python  the Python package: a wheel in build/python, installed there in an environment of its own, and tested
# make octave  the function zipact for Octave in build/octave, tested
# make web     the page web/dist/index.html: the actuator live in a browser; make check-web tests it, once in a browser
# make check-report  looks at the page of `zipact reproduce` in a browser
# make fmu     the actuator of examples/fmu.yaml as an FMU in out/, with a binary for Windows if mingw-w64 is there
# make install; make uninstall removes what it installed
# make deb     Debian packages in build-deb
# make windows the command and the library for Windows as a zip in build/win64, tried under wine
# make docs    the manual as HTML in build/docs/html, with all numbers and pictures of docs/ remade; make html without
#              remaking them; make check-docs looks at it
# Each installs what is missing (make deps alone does that), configures, builds and runs.

BUILD ?= build
JOBS  ?= $(shell nproc 2>/dev/null || echo 2)

# e.g. -DZIPACT_WERROR=ON
CMAKE_OPTIONS ?=

.PHONY: all demo check check-near nightly weekly mutants fmu python octave web check-web check-report deps bench bench-tables format check-format docs html check-docs validity verification install uninstall deb windows clean
all: $(BUILD)/zipact

deps:
	@scripts/deps.sh

$(BUILD)/CMakeCache.txt: | deps
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=Release $(CMAKE_OPTIONS) >$(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log

.PHONY: $(BUILD)/zipact
$(BUILD)/zipact: deps $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) --target zipact_command -- --no-print-directory

demo: $(BUILD)/zipact
	$(BUILD)/zipact run examples/demo.yaml --set output.animation=true -o out/demo
	@echo "pictures:"; ls -1 out/demo/plots/*.svg out/demo/plots/*.gif

check: deps $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) -- --no-print-directory
	cd $(BUILD) && ctest --output-on-failure -j $(JOBS) -LE nightly

check-near: deps $(BUILD)/CMakeCache.txt
	scripts/check-near.py $(BUILD)

nightly:
	.ci/nightly

weekly:
	.ci/weekly

mutants: deps
	scripts/mutants.py $(BUILD)

python: $(BUILD)/zipact
	scripts/test-python.sh $(BUILD)

octave: $(BUILD)/zipact
	scripts/test-octave.sh $(BUILD)

# The kit's binary for Windows, in the folder of the kit that the command takes.
$(BUILD)/fmu/binaries/x86_64-windows/zipact.dll: FORCE
	@cmake -S . -B $(BUILD)/win64 -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc \
	  -DCMAKE_BUILD_TYPE=Release -DZIPACT_IO=OFF -DZIPACT_TESTS=OFF >$(BUILD)/win64.log 2>&1 || { cat $(BUILD)/win64.log; exit 1; }
	@cmake --build $(BUILD)/win64 -j $(JOBS) --target zipact_fmu -- --no-print-directory
	@mkdir -p $(@D) && cp $(BUILD)/win64/fmu/binaries/x86_64-windows/zipact.dll $@
FORCE:

has_mingw := $(shell command -v x86_64-w64-mingw32-gcc 2>/dev/null)
fmu: $(BUILD)/zipact $(if $(has_mingw),$(BUILD)/fmu/binaries/x86_64-windows/zipact.dll)
	@mkdir -p out
	$(BUILD)/zipact fmu examples/fmu.yaml --fmi 2 -o out/arm-fmi2.fmu
	$(BUILD)/zipact fmu examples/fmu.yaml --fmi 3 -o out/arm-fmi3.fmu

bench: $(BUILD)/zipact
	$(BUILD)/zipact bench

bench-tables: $(BUILD)/zipact
	@cmake --build $(BUILD) -j $(JOBS) --target precision -- --no-print-directory
	bench/run.sh $(BUILD)

docs: $(BUILD)/zipact
	scripts/make-keys-page.sh $(BUILD)/zipact
	scripts/make-materials-page.py
	scripts/make-factor-page.sh $(BUILD)/zipact
	scripts/make-benchmark-page.py $(BUILD)/zipact
	scripts/run-manual.py $(BUILD)/zipact
	@$(MAKE) --no-print-directory html

html:
	scripts/deps.sh --docs
	scripts/make-html.py $(BUILD)/docs/html

check-docs:
	scripts/deps.sh --browser
	scripts/check-docs.sh $(BUILD)/docs/html

check-report: $(BUILD)/zipact
	scripts/deps.sh --browser
	$(BUILD)/zipact reproduce -o out/reproduce --quiet
	scripts/check-report.sh out/reproduce/report.html

validity: $(BUILD)/zipact
	scripts/make-validity-page.py $(BUILD)/zipact

verification: deps $(BUILD)/CMakeCache.txt
	@cmake --build $(BUILD) -j $(JOBS) -- --no-print-directory
	scripts/make-verification-page.py $(BUILD)

web:
	scripts/web.sh

check-web: $(BUILD)/zipact
	ZIPACT=$(abspath $(BUILD)/zipact) scripts/web.sh --test

# All sources in C; git's list would miss a new one.
c_sources = $(shell find bench benchmarks cli examples include octave python reproduce src tests web -name node_modules -prune -o -name build -prune -o -name '*.[ch]' -print)

format:
	clang-format -i $(c_sources)

check-format:
	@clang-format --dry-run -Werror $(c_sources)

# What was installed last, which `make uninstall` removes.
INSTALLED ?= $(BUILD)/installed.txt

install: $(BUILD)/zipact
	cmake --build $(BUILD) -j $(JOBS) && cmake --install $(BUILD)
	@cp $(BUILD)/install_manifest.txt $(INSTALLED)

uninstall:
	@test -f $(INSTALLED) || { echo "nothing to uninstall: make install has not written $(INSTALLED)" >&2; exit 1; }
	@while read -r file || [ -n "$$file" ]; do rm -f "$(DESTDIR)$$file"; done <$(INSTALLED)
	@sed 's|/[^/]*$$||' $(INSTALLED) | grep zipact | sort -ru | while read -r folder; do \
	  while rmdir "$(DESTDIR)$$folder" 2>/dev/null; do folder=$${folder%/*}; case $$folder in *zipact*) ;; *) break ;; esac; done; done
	@rm $(INSTALLED)

deb:
	scripts/make-deb.sh $(BUILD)

windows: $(BUILD)/zipact
	scripts/make-windows-zip.sh $(BUILD)

clean:
	rm -rf $(BUILD) out web/build web/dist web/node_modules
