"""Pictures by matplotlib: each function draws into an Axes, a new one if none is given, and returns it."""

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from ._zipact import InputError
from .actuator import KEYS
from .batch import value_in
from .drawing import Drawing
from .network import Network

if TYPE_CHECKING:
    from .batch import Batch
    from .result import FieldMap, Result, Shapes, Table

BLUE, RED, GREEN, GREY = "#0072b2", "#d55e00", "#009e73", "#999999"  # distinguishable with colour blindness
MILLI, KILO = 1e3, 1e-3  # factors from SI


def new_axes(ax: Axes | None, x: str, y: str) -> Axes:
    if ax is None:
        _, ax = plt.subplots(figsize=(6.4, 4), layout="constrained")
    ax.set(xlabel=x, ylabel=y)
    ax.grid(color="#dddddd")
    ax.set_axisbelow(True)
    return ax


def nan_where(hidden: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values with gaps, at which lines end."""
    return np.where(hidden, np.nan, values)


def outline(ax: Axes, film: "Shapes", frame: int, **style: Any) -> list[Any]:
    """The ribbons of one shape, member by member."""
    parts = zip(*(np.split(of[frame], film.members) for of in (film.x, film.y)), strict=True)
    return [line for x, y in parts for line in ax.plot(MILLI * x, MILLI * y, **style)]


# -- by study -------------------------------------------------------------------------------------------


def names_of(table: "Table", ending: str) -> list[str]:
    """Names of a network's bodies or members that have such columns: hand, of hand.y_m."""
    return [column.removesuffix(ending) for column in table if column.endswith(ending)]


def network(table: "Table", ax: Axes | None) -> Axes:
    """Heights of bodies, openings and voltages of members; in the plane angles of bodies and openings."""
    angles = names_of(table, ".angle_rad")
    ax = new_axes(ax, "time / ms", "opening / mm" if angles else "height, opening / mm")
    time, right = MILLI * table["time_s"], ax.twinx()
    for name in angles or names_of(table, ".y_m"):
        label, of = (f"{name}, angle", np.degrees(table[name + ".angle_rad"])) if angles else (f"{name}, height", MILLI * table[name + ".y_m"])
        (right if angles else ax).plot(time, of, label=label)
    for place, name in enumerate(names_of(table, ".voltage_V"), len(angles)):
        (line,) = ax.plot(time, MILLI * table[name + ".opening_m"], linestyle="--", label=f"{name}, opening", **({"color": f"C{place}"} if angles else {}))
        if not angles:
            right.plot(time, KILO * table[name + ".voltage_V"], color=line.get_color(), linestyle=":", linewidth=1)
    right.set_ylabel("angle / degree" if angles else "voltage (dotted) / kV")
    if angles:
        right.margins(y=0.3)  # an opening may change as an angle does
    else:
        right.set_ylim(bottom=min(0, right.get_ylim()[0]))
    drawn = [line for axes in ((right, ax) if angles else (ax,)) for line in axes.lines]
    ax.legend(handles=drawn, fontsize="small")
    return ax


def actuate(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    if names_of(table, ".y_m"):
        return network(table, ax)
    ax = new_axes(ax, "time / ms", "stroke / mm")
    time, voltage = MILLI * table["time_s"], table["voltage_V"]
    ax.plot(time, MILLI * table["stroke_m"], color=BLUE)
    zipped = result.get("zip_time_s", np.nan)
    if np.isfinite(zipped):
        ax.axvline(MILLI * zipped, color=GREY, linestyle="--")
    if np.ptp(voltage) > 0:
        right = ax.twinx()
        right.plot(time, KILO * voltage, color=RED, linewidth=1)
        right.set_ylabel("voltage / kV", color=RED)
    return ax


def limits(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    ax = new_axes(ax, "voltage / kV", "load / g")
    words = ("pull-in", "closing", "release", "largest load")
    for limit, voltage, load in zip(table["limit"], table["voltage_V"], table["load_kg"]):
        ax.plot(KILO * voltage, MILLI * load, "o", label=words[int(limit)])
    ax.legend()
    return ax


def equilibrium(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    bodies = names_of(table, ".y_m")
    opening = "opening_m" if np.isfinite(table["opening_m"]).any() else "stroke_m"
    columns = [name + ".y_m" for name in bodies] or [opening]
    ax = new_axes(ax, "voltage / kV", f"height of {', '.join(bodies)} / mm" if bodies else opening.replace("_m", " / mm"))
    stable = table["stable"] == 1
    for branch, column in itertools.product(np.unique(table["branch"]), columns):
        other = table["branch"] != branch
        x, y = KILO * table["voltage_V"], MILLI * table[column]
        # an unstable stretch begins and ends at its stable neighbours
        inner = stable & np.r_[True, stable[:-1]] & np.r_[stable[1:], True]
        ax.plot(x, nan_where(other | inner, y), color=RED, linestyle="--")
        ax.plot(x, nan_where(other | ~stable, y), color=BLUE)
    for name, text in (("pull_in_voltage_V", "pull-in"), ("release_voltage_V", "release")):
        if np.isfinite(result[name]):
            ax.axvline(KILO * result[name], color=GREY, linestyle=":")
            at = (KILO * result[name], 0.8)
            ax.annotate(f" {text}\n {at[0]:.4g} kV", at, xycoords=("data", "axes fraction"))
    ax.plot([], [], color=BLUE, label="stable")
    ax.plot([], [], color=RED, linestyle="--", label="unstable")
    ax.legend()
    return ax


def isometric(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    ax = new_axes(ax, "voltage / kV", "force / N")
    ax.plot(KILO * table["voltage_V"], table["force_N"], color=BLUE)
    return ax


def modes(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    ax = new_axes(ax, "x / mm", "y / mm")
    film, most = result.shapes, 4
    outline(ax, film, 0, color=GREY)
    for mode in range(min(most, len(film.time) - 1)):
        colour = colormaps["viridis"](mode / most)
        lines = outline(ax, film, mode + 1, color=colour)
        lines[0].set_label(f"{table['frequency_Hz'][mode]:.4g} Hz")
    ax.legend()
    return ax


def stationary(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    if isinstance(result.actuator, Network):
        return Drawing(result, ax).axes
    ax = shapes(result.shapes, ax)
    ax.set_aspect("equal")
    return ax


def profile(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    ax = new_axes(ax, "x / mm", "force per length / (N/m)")
    x = MILLI * table["x_m"]
    ax.semilogy(x, table["field_N_per_m"], color="#56b4e9", linewidth=4, label="field")
    ax.semilogy(x, table["plates_N_per_m"], color="black", linestyle="--", label="plates law")
    if (table["capped"] == 1).any():
        ax.semilogy(x, table["force_N_per_m"], color=RED, label="with breakdown")
    ax.legend()
    return ax


def residuals(table: "Table", what: str, ax: Axes | None) -> Axes:
    """Residuals, kind by kind of measurement, where they are known divided by the standard deviations; `what`: the only kind."""
    names = [name for name in table if name.startswith("residual_")]
    weighted = any(name.startswith("sigma_") for name in table)
    ax = new_axes(ax, "row of data", "residual / standard deviation" if weighted else f"residual / {table.units[names[0]]}")
    for name in names:
        kind = name.removeprefix("residual_")
        label = what if kind == table.units[name] else kind.removesuffix("_" + table.units[name]).replace("_", " ")
        there = np.flatnonzero(np.isfinite(table[name]))
        sigma = table["sigma_" + kind] if weighted else 1
        ax.plot(there + 1, (table[name] / sigma)[there], "o", label=label)
    ax.axhline(0, color=GREY, linewidth=1)
    ax.legend()
    return ax


def calibrate(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    """One kind of measurement against one quantity that was set, or residuals of more."""
    what = result.actuator["calibrate.y"].rpartition("_")[0] or "measured"
    x, measured, fitted, *_ = table
    if not measured.startswith("measured_") or sum(name.startswith("measured_") for name in table) > 1:
        return residuals(table, what, ax)
    (by_x, unit_x), (by_y, unit_y) = (shown_unit(table.units[name], table[name]) for name in (x, measured))
    ax = new_axes(ax, axis_label(x.removesuffix("_" + table.units[x]), unit_x), axis_label(what, unit_y))
    order = np.argsort(table[x])
    ax.plot(by_x * table[x][order], by_y * table[fitted][order], color=BLUE, label="model")
    ax.plot(by_x * table[x], by_y * table[measured], "o", color=RED, fillstyle="none", label="measured")
    ax.legend()
    return ax


def plan(result: "Result", table: "Table", ax: Axes | None) -> Axes:
    """Expected error of the fitted keys over the number of measurements, planned and evenly spaced."""
    ax = new_axes(ax, "number of measurements", "relative standard error / %")
    ax.semilogy(table["rank"], 100 * table["even_relative_error"], "o-", color=RED, fillstyle="none", label="evenly spaced")
    ax.semilogy(table["rank"], 100 * table["relative_error"], "o-", color=BLUE, label="planned")
    ax.legend()
    return ax


STUDIES = {
    "actuate": actuate,
    "calibrate": calibrate,
    "cycle": actuate,
    "equilibrium": equilibrium,
    "isometric": isometric,
    "limits": limits,
    "modes": modes,
    "plan": plan,
    "profile": profile,
    "stationary": stationary,
}


def result(result: "Result", ax: Axes | None = None) -> Axes:
    """The main result of the study."""
    if result.series is None or len(result.series.values_2d) == 0:
        raise InputError(f"study {result.study} ended without a table: {result.message}")
    ax = STUDIES[result.study](result, result.series, ax)
    ax.set_title(f"{result.study}: {result.message}", fontsize="medium")
    return ax


# -- batches --------------------------------------------------------------------------------------------


def shown_unit(unit: str, values: np.ndarray) -> tuple[float, str]:
    """A factor from SI, and its unit, in which the values are easy to read."""
    usual = {"kg": (MILLI, "g"), "m2/s": (1e6, "mm2/s"), "m3": (1e9, "uL")}
    if unit in usual:
        return usual[unit]
    largest = np.nanmax(np.abs(values), initial=0.0)
    if unit not in ("m", "s", "V", "A", "N", "F", "J", "Pa", "W", "Hz", "V/m") or largest == 0:
        return 1, "" if unit in ("1", "count") else unit
    for factor, prefix in ((1e-9, "G"), (1e-6, "M"), (1e-3, "k"), (1, ""), (1e3, "m"), (1e6, "u"), (1e9, "n")):
        if largest * factor >= 1:
            return factor, prefix + unit
    return 1e12, "p" + unit


def axis_label(name: str, unit: str) -> str:
    """zip_time_s in ms => zip time / ms"""
    return f"{name} / {unit}" if unit else name


def batch(batch: "Batch", y: str | None, x: str | None, ax: Axes | None) -> Axes:
    """A number of all runs against a key in which they differ."""
    varied = batch.varied
    numeric = [key for key in varied if KEYS[key].kind not in ("word", "text", "bool")]
    if not numeric or (x is not None and x not in varied):
        raise InputError(f"x = {x!r}: the actuators differ in {', '.join(varied) or 'no key'}; x must be one of these keys")
    x = x or max(numeric, key=lambda key: len({value_in(values, key) for values in batch.values}))
    y = y or next((name for found in batch if not isinstance(found, Exception) for name in found), "")
    unit_x, unit_y = KEYS[x].unit, batch.units.get(y, "1")
    across, up = np.array([value_in(values, x) for values in batch.values], dtype=float), batch[y]
    (by_x, shown_x), (by_y, shown_y) = shown_unit(unit_x, across), shown_unit(unit_y, up)
    name = y.removesuffix("_" + unit_y.replace("/", "_per_")).replace("_", " ")
    ax = new_axes(ax, axis_label(x, shown_x), axis_label(name, shown_y))
    others = [key for key in varied if key != x]
    groups: dict[tuple[str, ...], list[int]] = {}
    for place, values in enumerate(batch.values):
        groups.setdefault(tuple(value_text(key, value_in(values, key)) for key in others), []).append(place)
    for line, (words, places) in enumerate(groups.items()):
        order = sorted(places, key=lambda place: across[place])
        colour = colormaps["viridis"](0.9 * line / max(1, len(groups) - 1))
        ax.plot(by_x * across[order], by_y * up[order], "o-", color=colour, markersize=4, label=", ".join(words))
    if others:
        ax.legend(title=", ".join(others), fontsize="small")
    return ax


def value_text(key: str, value: Any) -> str:
    """0.008 of load.mass => 8 g"""
    if not isinstance(value, float):
        return str(value)
    factor, unit = shown_unit(KEYS[key].unit, np.array([value]))
    return f"{factor * value:.6g} {unit}".rstrip()


# -- shapes and fields ----------------------------------------------------------------------------------


def shapes(film: "Shapes", ax: Axes | None = None) -> Axes:
    """All shapes over time, early ones pale."""
    ax = new_axes(ax, "x / mm", "y / mm")
    shades = np.linspace(1, 0.15, len(film.time))[::-1]
    for frame, shade in enumerate(shades):
        outline(ax, film, frame, color=colormaps["viridis_r"](shade), linewidth=1)
    return ax


def field(map: "FieldMap", ax: Axes | None = None) -> Axes:
    """Strength of the field; metal is grey."""
    ax = new_axes(ax, "x / mm", "y / mm")
    strength = np.ma.masked_where(map.permittivity == 0, 1e-6 * map.strength)
    colours = colormaps["YlOrRd"].with_extremes(bad="#8c8c8c")
    mesh = ax.pcolormesh(MILLI * map.x, MILLI * map.y, strength, cmap=colours, shading="flat", rasterized=True)
    metal = np.pad(map.permittivity == 0, ((0, 1), (0, 1)))  # at the lower left node of each cell
    bottom, top = MILLI * map.y[metal].min(), MILLI * map.y[metal].max()
    ax.set_ylim(bottom - 0.3 * (top - bottom), top + 0.3 * (top - bottom))
    ax.figure.colorbar(mesh, ax=ax, label="field strength / (MV/m)")
    return ax
