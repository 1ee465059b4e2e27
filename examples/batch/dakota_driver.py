#!/usr/bin/env python3
"""What Dakota runs for each point:  dakota_driver.py PARAMETERS RESULTS

Dakota's file of parameters has lines "value descriptor": the variables, whose descriptors are keys of zipact, and
"ASV_1:pull_in_voltage_V", the outputs that it asks for. A case without an answer is a failed evaluation.
"""

import json
import subprocess
import sys


def read(path):
    """=> {descriptor: text} in the order of the file."""
    with open(path) as file:
        pairs = [line.split() for line in file if line.strip()]
    return {name: value for value, name in pairs}


def main():
    parameters = read(sys.argv[1])
    count = int(parameters.pop("variables"))
    keys = {name: float(value) for name, value in list(parameters.items())[:count]}
    outputs = [name.split(":", 1)[1] for name in parameters if name.startswith("ASV_")]
    words = ["zipact", "batch", "--set", "study=limits", "--set", "liquid.model=none", "--set", "output.errors=false"]
    answer = json.loads(subprocess.run(words, input=json.dumps(keys) + "\n", stdout=subprocess.PIPE, text=True, check=True).stdout)
    with open(sys.argv[2], "w") as file:
        for name in outputs:
            value = answer.get(name)
            print("fail" if value is None else "%.17g %s" % (value, name), file=file)


if __name__ == "__main__":
    main()
