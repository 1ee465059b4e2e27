"""Calibrate: which Young's modulus explains the strokes that were measured under nine loads?

    python3 calibrate.py MEASURED.csv [PICTURE]

MEASURED.csv has columns load_g and stroke_mm, as examples/data/finite-element-strokes.csv of the repository, for one
ribbon of the paper's finite-element reference.
"""

import sys

import zipact


def main(measured: str, picture: str = "calibrate.png") -> None:
    start = zipact.Actuator(preset="paper-fe", ribbon__young_modulus="150 GPa")
    fit = start.replace(data__file=measured, calibrate__fit="ribbon.young_modulus")
    fit = fit.replace(calibrate__x="load_g", calibrate__y="stroke_mm")

    result = fit.run("calibrate")
    modulus, error = result["ribbon.young_modulus"], result["ribbon.young_modulus_standard_error"]
    print(f"Young's modulus {modulus / 1e9:.2f} +- {error / 1e9:.2f} GPa; {result.message}")
    result.plot().figure.savefig(picture)

    fitted = start.replace(ribbon__young_modulus=modulus)
    stroke = fitted.replace(load__mass="120 g").run("stationary")["stroke_m"]
    print(f"so 120 g, which were not measured, give a stroke of {1e3 * stroke:.2f} mm")


if __name__ == "__main__":
    main(*sys.argv[1:])
