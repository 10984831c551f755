# Every target works from a fresh clone; `make setup` gets the tools.

VURIS := $(or $(CARGO_TARGET_DIR),target)/release/vuris

# One target after the other even under `make -j` (cargo is parallel by itself), and none
# of its flags in the environment of the makes that run further down.
.NOTPARALLEL:
unexport MAKEFLAGS MFLAGS

.DEFAULT_GOAL := help
.PHONY: help setup build demo test slow lint cocotb generate synth mutate coverage prove study proof open-question catalogue real-pages picture clean

help:      ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile

setup:     ## find the tools, install what is missing (bash scripts/setup.sh --check only looks)
	@bash scripts/setup.sh

build:     ## build the program: target/release/vuris
	cargo build --release --locked

demo: setup build ## run the demonstration
	$(VURIS) demo

lint: setup ## the generated Verilog in Verilator, Icarus, Yosys' check and verible
	@bash scripts/hdl-tools.sh style
	cargo test --release --locked --test lint
	cargo test --release --locked --test synthesis loose_wire

# A core of each preset with a small sensor, several seeds, both simulators.
cocotb: setup build ## the core against numpy, as an outside user would test it
	@bash scripts/hdl-tools.sh cocotb
	@bash tb/cocotb/all.sh $(VURIS)

# One profile for all: what lints, documentation and program have in common is built once.
test: setup ## every check: format, lints, tests, documentation, generated files
	@bash scripts/hdl-tools.sh style cocotb fusesoc
	cargo fmt --check
	cargo clippy --release --all-targets --locked -- -D warnings
	cargo build --release --locked
	cargo test --release --locked
	RUSTDOCFLAGS='-D warnings' cargo doc --release --no-deps --locked
	$(VURIS) generate --spec vuris --out generated --check

generate: build ## write generated/ anew
	$(VURIS) generate --spec vuris --out generated

slow: build ## the diagnosis's tests that take minutes each, which make test leaves out
	cargo test --release --locked -- --ignored

synth: build ## area and clock frequency of every target (minutes; ACCEPT=1 takes changed areas for the baseline)
	bash scripts/hdl-tools.sh synth
	$(VURIS) synth --out generated $(if $(ACCEPT),--accept)

mutate: setup build ## faults that the benches must kill: docs/mutation-*.md (ten minutes)
	$(VURIS) mutate --spec vuris --per-module 30 --seed 1 --out docs
	$(VURIS) mutate --spec vuris-fast --per-module 30 --seed 1 --out docs

coverage: setup build ## lines that run and bits that move: docs/coverage-*.md
	$(VURIS) coverage --spec vuris --out docs
	$(VURIS) coverage --spec vuris-fast --out docs

prove: setup build ## formal proofs, their covers, and designs in which each must fail
	$(VURIS) prove --spec vuris

study: build ## how often the diagnosis is right: docs/study.md (half an hour)
	$(VURIS) study --nulls 200 --repeats 1 --pairs 24 --unknowns 2 --seed 1 --out docs

PROOF := $(or $(CARGO_TARGET_DIR),target)/proof

proof: build ## two hundred blind campaigns of a second generator: made, answered, scored (half an hour)
	rm -rf $(PROOF) $(PROOF)-labels.json
	$(VURIS) challenge make --cases 200 --seed-from-entropy --out $(PROOF)
	$(VURIS) challenge answer $(PROOF)
	@date -u +%F
	$(VURIS) challenge score $(PROOF) --labels $(PROOF)-labels.json --json $(PROOF)-score.json

open-question: build ## the paper's open question asked of the diagnosis: docs/open-question.md anew (three minutes)
	bash scripts/pages/open-question.sh $(VURIS)

catalogue: setup build ## effects written down again, in numpy, and diagnosed: docs/catalogue.md anew (half an hour)
	@bash scripts/hdl-tools.sh cocotb
	bash scripts/pages/catalogue.sh $(VURIS)

# The recordings are not part of this repository; VURIS_REAL names the folder that has them.
real-pages: build ## real recordings diagnosed: docs/real-*.md anew (VURIS_REAL=DIR with flimfast/ and cfpe/)
	bash scripts/pages/flimfast.sh $(VURIS)
	bash scripts/pages/cfpe.sh $(VURIS)

picture: setup build ## draw the pictures in docs/images anew
	$(VURIS) scene --out docs/images

clean:     ## remove what cargo built (the tools in .tools stay)
	cargo clean
