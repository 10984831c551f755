"""Builds a generated core and runs test_pipeline.py on it.

    python tb/cocotb/run.py FOLDER [--simulator icarus|verilator] [--build DIR] [--seed N] [--test NAME]

FOLDER is what `vuris generate --out FOLDER` has written. Exit code 1: a test has failed.
"""

import argparse
import os
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from cocotb_tools.runner import get_results, get_runner  # noqa: E402

HERE = Path(__file__).resolve().parent


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="a folder that `vuris generate` has written")
    parser.add_argument("--simulator", choices=["icarus", "verilator"], default="icarus")
    parser.add_argument("--build", type=Path, help="where to build; a temporary folder where it is not given")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--test", help="only the test of this name")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    if not (folder / "doc/explanation.json").is_file():
        parser.error(f"{folder} has no doc/explanation.json: `vuris generate --out {folder}` writes it")
    if arguments.build:
        return run(folder, arguments, arguments.build.resolve())
    with tempfile.TemporaryDirectory(prefix="vuris-cocotb-") as build:
        return run(folder, arguments, Path(build))


def run(folder, arguments, build):
    sources = [folder / line for line in (folder / "rtl/files.f").read_text().splitlines() if line.endswith(".v")]
    top = sources[-1].stem
    options = {"icarus": ["-g2005"], "verilator": ["-Wno-fatal"]}
    # Of Verilator the repository's own, where `make setup` has put it: cocotb 2.1 does not build with Debian's 5.006.
    own = HERE.parent.parent / ".tools/verilator/verilator"
    if arguments.simulator == "verilator" and own.is_dir():
        os.environ["PATH"] = os.pathsep.join([str(own / "bin"), os.environ["PATH"]])
        os.environ["VERILATOR_ROOT"] = str(own)
    runner = get_runner(arguments.simulator)
    runner.build(
        sources=sources,
        hdl_toplevel=top,
        build_dir=build,
        build_args=options[arguments.simulator],
        # Icarus and the tests' clock want one; the core has none.
        timescale=("1ns", "1ps"),
        always=True,
    )
    results = runner.test(
        hdl_toplevel=top,
        test_module="test_pipeline",
        build_dir=build,
        test_dir=HERE,
        results_xml=str(build / "results.xml"),
        test_filter=arguments.test,
        extra_env={
            "VURIS_CORE": str(folder),
            "VURIS_SEED": str(arguments.seed),
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONPATH": os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")])),
        },
    )
    tests, failed = get_results(results)
    print(f"{top} in {arguments.simulator}: {tests} tests, {failed} failed")
    return 0 if tests > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
