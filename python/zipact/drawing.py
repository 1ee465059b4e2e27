"""Drawings of ribbons, bodies, joints and springs by matplotlib, at rest and as a film."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from ._zipact import InputError
from .network import Network
from .result import grouped

if TYPE_CHECKING:
    from .result import Result

METAL, RIGID, GROUND, SPRING, BETWEEN = "#37434d", "#777777", "#222222", "#009e73", "#cfe6f4"
MILLI = 1e3  # from SI
FILM = 4800.0  # ms, which a film takes, unless its frames would be too short or too long
SHORTEST, LONGEST = 20.0, 400.0  # ms, of a frame
FLAT = 0.3  # height over width, below which x and y have scales of their own
MOST_NAMES = 12  # of bodies that are written


class Part(NamedTuple):
    """What is drawn with its points in each frame."""

    artist: Artist
    x: np.ndarray
    """[frames, points] m"""
    y: np.ndarray
    """[frames, points] m"""


class Pose(NamedTuple):
    """Where a body is in each frame, [frames] m and rad, and its drawn angle."""

    x: np.ndarray
    y: np.ndarray
    turn: np.ndarray
    drawn: float = 0.0

    def point(self, u: float, v: float) -> tuple[np.ndarray, np.ndarray]:
        """A point along its own axes from its place."""
        cos, sin = np.cos(self.turn), np.sin(self.turn)
        return self.x + cos * u - sin * v, self.y + sin * u + cos * v


def at(keys: Mapping[str, Any], key: str) -> tuple[float, float]:
    """A point of the drawing, m."""
    x, y = (keys.get(f"{key}.{way}", 0.0) for way in "xy")
    return float(x), float(y)


class Drawing:
    """The shapes of a result in axes, and for a network its bodies, joints and springs. Frame 0 is shown."""

    def __init__(self, result: "Result", ax: Axes | None) -> None:
        if result.shapes is None:
            raise InputError(f"study {result.study} has no shapes")
        self.film = result.shapes
        if ax is None:
            _, ax = plt.subplots(figsize=(6.4, 4.8), layout="constrained")
        self.axes = ax
        self.parts: list[Part] = []
        actuator = result.actuator
        self.values = actuator._values() if isinstance(actuator, Network) else actuator
        self.members = grouped(self.values, "members")
        self.bodies = grouped(self.values, "bodies")
        self.poses = self._poses(result)
        self.plane = any(f"bodies.{name}.angle_rad" in result or f"{name}.angle_rad" in (result.series or ()) for name in self.bodies)
        self._ribbons()
        if self.plane:
            self._in_plane()
        elif self.bodies:
            self._up_and_down()
        else:
            self._alone()
        self._frame_axes()
        self.show(0)

    # -- where things are

    def _poses(self, result: "Result") -> dict[str, Pose]:
        """Of each body in each frame: of a run at the time of the frame, at rest as the summary has it."""
        still, series = np.zeros(len(self.film.time)), result.series
        poses = {"frame": Pose(still, still, still)}
        for name, keys in self.bodies.items():

            def along(number: str, otherwise: float, name: str = name) -> np.ndarray:
                if series is not None and "time_s" in series and f"{name}.{number}" in series:
                    return np.interp(self.film.time, series["time_s"], series[f"{name}.{number}"])
                return still + result.get(f"bodies.{name}.{number}", otherwise)

            x, y = at(keys, "at")
            drawn = float(keys.get("angle", 0.0))
            poses[name] = Pose(along("x_m", x), along("y_m", y), along("angle_rad", drawn), drawn)
        return poses

    def _place(self, member: str) -> float:
        """Of the middle of a member of bodies that move up and down: that of its lower body, m."""
        return float(self.poses[self.members[member]["lower"]].x[0])

    @property
    def nodes(self) -> int:
        return self.film.x.shape[1] // self.film.members

    def _half(self) -> bool:
        """Do shapes have the left half of a symmetric actuator?"""
        kind, symmetry = self.values["actuator.kind"], self.values["actuator.symmetry"]
        return not self.plane and self.film.x.shape[2] > 1 and (kind, symmetry) == ("electro_ribbon", "half")

    # -- what is drawn

    def add(self, artist: Artist, x: np.ndarray, y: np.ndarray) -> None:
        self.axes.add_artist(artist)
        self.parts.append(Part(artist, MILLI * np.atleast_2d(x), MILLI * np.atleast_2d(y)))

    def line(self, points: list[tuple[np.ndarray, np.ndarray]], **style: Any) -> None:
        """Through points, of which each has its x and y in each frame."""
        x, y = (np.stack(np.broadcast_arrays(*along), axis=-1) for along in zip(*points, strict=True))
        self.add(Line2D([], [], **style), x, y)

    def _ribbons(self) -> None:
        half, film, names = self._half(), self.film, list(self.members) or [""] * self.film.members
        platform = self.values["platform.length"] if self.values["actuator.kind"] == "electro_ribbon" else 0
        last = self.nodes - 1 if half else self.nodes // 2 - 1
        for k, name in enumerate(names):
            x, y = (of[:, k * self.nodes : (k + 1) * self.nodes] for of in (film.x, film.y))
            if not self.plane and platform:
                middle = x[0, last, 0] + platform / 2
                x = x - middle + (self._place(name) if name else 0)
            if half:
                about = self._place(name) if name else 0
                x, y = np.concatenate([x, 2 * about - x[:, ::-1]], axis=1), np.concatenate([y, y[:, ::-1]], axis=1)
            self._pair(x, y)

    def _pair(self, x: np.ndarray, y: np.ndarray) -> None:
        """Two ribbons and what is between them, or one."""
        if x.shape[2] > 1:
            around = (np.concatenate([of[:, :, 0], of[:, ::-1, 1]], axis=1) for of in (x, y))
            self.add(Polygon([(0, 0)], facecolor=BETWEEN, edgecolor="none", zorder=0), *around)
        for r in range(x.shape[2]):
            self.add(Line2D([], [], color=METAL, linewidth=1.6, zorder=2), x[:, :, r], y[:, :, r])

    def _bar(self, x: np.ndarray, y: np.ndarray, angle: Any, length: float, **style: Any) -> None:
        """A straight piece about its middle."""
        along, up = 0.5 * length * np.cos(angle), 0.5 * length * np.sin(angle)
        self.line([(x - along, y - up), (x + along, y + up)], **{"color": RIGID, "linewidth": 5, "solid_capstyle": "butt", "zorder": 4} | style)

    def _name(self, words: str, x: np.ndarray, y: np.ndarray, **place: Any) -> None:
        text = self.axes.annotate(words, (0, 0), xytext=(4, -4), textcoords="offset points", fontsize=8, color=METAL, zorder=6, va="top")
        text.set(**place)
        self.parts.append(Part(text, MILLI * np.reshape(x, (-1, 1)), MILLI * np.reshape(y, (-1, 1))))

    def _alone(self) -> None:
        """The platforms of an actuator, and its load."""
        values, film = self.values, self.film
        if values["actuator.kind"] != "electro_ribbon":
            return
        length, still = values["platform.length"], np.zeros(len(film.time))
        node = self.nodes - 1 if self._half() else self.nodes // 2 - 1
        low = film.y[:, (self.film.members - 1) * self.nodes + node, 1]
        self._bar(still, still, 0, length, color=GROUND)
        self._bar(still, low, 0, length)
        if values["load.mass"] > 0 and not isinstance(values["stack.distance"], float):
            below = 0.12 * np.ptp(film.x)
            self.line([(still, low), (still, low - below)], color=METAL, linewidth=1)
            self.line([(still, low - below)], color=RIGID, marker="s", markersize=14, linestyle="none")
            self._name(f"{MILLI * values['load.mass']:.4g} g", still, low - below, position=(12, 0), va="center")

    def _up_and_down(self) -> None:
        """Bodies as wide as their members, ropes and springs at their middles."""
        length, ends = self.values["platform.length"], {name: [np.inf, -np.inf] for name in self.poses}
        for name, keys in self.members.items():
            for body in (keys["upper"], keys["lower"]):
                ends[body][0] = min(ends[body][0], self._place(name) - length / 2)
                ends[body][1] = max(ends[body][1], self._place(name) + length / 2)
        ends = {name: (left, right) if left < right else (-length / 2, length / 2) for name, (left, right) in ends.items()}
        for name, (left, right) in ends.items():
            y = self.poses[name].y
            held = name == "frame" or self.bodies[name].get("moves") == "none"
            self._bar(y * 0 + (left + right) / 2, y, 0, right - left, color=GROUND if held else RIGID)
            carries = any(keys["upper"] == name for keys in self.members.values())
            if name != "frame" and len(self.bodies) <= MOST_NAMES and carries:
                self._name(name, y * 0 + right, y, va="bottom", position=(3, 3))
            elif name != "frame" and len(self.bodies) <= MOST_NAMES:
                self._name(name, y * 0 + (left + right) / 2, y, ha="center", position=(0, -5))
        for keys in grouped(self.values, "springs").values():
            middle = [sum(ends[body]) / 2 for body in (keys["first"], keys["second"])]
            self._spring(*((self.poses[keys[end]].y * 0 + x, self.poses[keys[end]].y) for end, x in zip(("first", "second"), middle, strict=True)))

    def _spring(self, one: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> None:
        self.line([one, other], color=SPRING, linewidth=1.5, linestyle=(0, (2, 1)), zorder=5)

    def _in_plane(self) -> None:
        """Bodies as lines from their places to all that is fixed to them; platforms, springs and joints."""
        limbs: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {name: [] for name in self.bodies}

        def fixed(body: str, point: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
            where = self.poses[body].point(*point)
            limbs.setdefault(body, []).append(where)
            return where

        for keys in self.members.values():
            for end in ("upper", "lower"):
                body = keys[end]
                pose, angle = self.poses[body], keys.get("angle", 0.0)
                turned = (angle if isinstance(angle, float) else 0.0) + pose.turn - pose.drawn
                where = fixed(body, at(keys, f"{end}_at"))
                self._bar(*where, turned, self.values["platform.length"], color=GROUND if body == "frame" else RIGID)
        for keys in grouped(self.values, "springs").values():
            self._spring(fixed(keys["first"], at(keys, "from_at")), fixed(keys["second"], at(keys, "to_at")))
        for keys in grouped(self.values, "joints").values():
            points = [fixed(body, self._own(body, at(keys, "at"))) for body in (keys["first"], keys["second"])]
            marker = "o" if keys.get("type", "pin") == "pin" else "s"
            self.line(points[:1], color=GROUND, marker=marker, markerfacecolor="white", markersize=6, linestyle="none", zorder=6)
        for name, points in limbs.items():
            if name == "frame" or self.bodies[name].get("moves") == "none":
                continue
            place = self.poses[name].point(0, 0)
            for point in points:
                self.line([place, point], color=RIGID, linewidth=4, solid_capstyle="round", zorder=1)
            if len(self.bodies) <= MOST_NAMES:
                self._name(name, *place)

    def _own(self, body: str, point: tuple[float, float]) -> tuple[float, float]:
        """A point of the drawing along the own axes of a body, from its place."""
        keys = self.bodies.get(body, {})
        (x, y), (x0, y0), angle = point, at(keys, "at"), float(keys.get("angle", 0.0))
        cos, sin = math.cos(angle), math.sin(angle)
        return cos * (x - x0) + sin * (y - y0), -sin * (x - x0) + cos * (y - y0)

    def _frame_axes(self) -> None:
        ax, x, y = self.axes, *(np.concatenate([np.ravel(of) for of in along]) for along in zip(*((p.x, p.y) for p in self.parts), strict=True))
        left, right, bottom, top = x.min(), x.max(), y.min(), y.max()
        flat = top - bottom < FLAT * (right - left)
        margin = 0.06 * max(right - left, 1e-6), 0.1 * max(top - bottom, 0.02 * (right - left), 1e-6)
        ax.set(xlabel="x / mm", ylabel="y / mm", xlim=(left - margin[0], right + margin[0]), ylim=(bottom - margin[1], top + margin[1]))
        ax.grid(color="#dddddd")
        ax.set_axisbelow(True)
        if flat:
            ax.annotate("x and y have different scales", (0.99, 0.01), xycoords="axes fraction", ha="right", va="bottom", fontsize=8, color=RIGID)
        else:
            ax.set_aspect("equal")

    def show(self, frame: int) -> list[Artist]:
        """Show a frame of the shapes."""
        for artist, x, y in self.parts:
            here = x[min(frame, len(x) - 1)], y[min(frame, len(y) - 1)]
            if isinstance(artist, Line2D):
                artist.set_data(*here)
            elif isinstance(artist, Polygon):
                artist.set_xy(np.column_stack(here))
            else:
                artist.xy = (here[0][0], here[1][0])  # type: ignore[attr-defined]
        return [part.artist for part in self.parts]


class Animation(FuncAnimation):
    """A film of a run, which a notebook shows and `save` writes: animation.save("zip.gif")."""

    def __init__(self, result: "Result", ax: Axes | None = None, frames: int = 80) -> None:
        if result.series is None or "time_s" not in result.series or result.shapes is None or len(result.shapes.time) < 2:
            raise InputError(f"study {result.study}: animate takes a run in time that has moved, as of study actuate")
        if not isinstance(frames, int) or frames < 2:
            raise InputError(f"frames = {frames!r}: takes a whole number of at least 2")
        self.drawing = Drawing(result, ax)
        time = result.shapes.time
        even = np.linspace(time[0], time[-1], min(frames, len(time)))
        self.shown: list[int] = sorted({int(np.abs(time - wanted).argmin()) for wanted in even})
        """the frames of result.shapes that it shows: evenly in time"""
        interval = min(LONGEST, max(SHORTEST, FILM / len(self.shown)))
        slower = 1e-3 * interval * (len(self.shown) - 1) / (time[-1] - time[0])
        pace = f"slow motion, {slower:.3g} times slower than real" if slower >= 1 else f"fast motion, {1 / slower:.3g} times faster than real"
        title = self.drawing.axes.set_title("", fontsize="medium")

        def draw(frame: int) -> list[Artist]:
            title.set_text(f"t = {MILLI * time[frame]:.1f} ms\n{pace}")
            return [title, *self.drawing.show(frame)]

        figure = self.drawing.axes.figure
        if ax is None:
            draw(0)
            figure.canvas.draw()
            figure.set_layout_engine("none")  # once: all frames have the same layout
        super().__init__(figure, draw, self.shown, interval=interval, blit=False, repeat_delay=1000, cache_frame_data=False)

    def save(self, filename: Any, writer: Any = None, **options: Any) -> None:
        """As FuncAnimation.save; a GIF needs nothing but Pillow."""
        super().save(filename, writer or ("pillow" if str(filename).lower().endswith(".gif") else None), **options)

    def _repr_html_(self) -> str:
        """The film, in place of its first frame."""
        plt.close(self.drawing.axes.figure)  # type: ignore[arg-type]
        return self.to_jshtml()
