#!/usr/bin/env python3
"""What other programs find in the files of a folder of results: h5py in results.h5, a reader of VTK's XML in the files for
ParaView, Python's csv in table.csv.

    read_back.py FOLDER    prints it as JSON, a missing value as null
"""
import csv
import json
import math
import os
import struct
import sys
import xml.etree.ElementTree as xml

import h5py

TYPES = {"Float64": "d", "Int64": "q"}


def plain(value):
    """A number as JSON has it, a string as text."""
    if isinstance(value, bytes):
        return value.rstrip(b"\0").decode()
    return None if isinstance(value, float) and math.isnan(value) else value


def hdf5(path):
    """{path: {attributes, shape, values}} of all datasets, {path: {attributes}} of all groups."""
    found = {}

    def visit(name, item):
        about = {key: plain(value) for key, value in item.attrs.items()}
        if isinstance(item, h5py.Dataset):
            values = item[()].ravel().tolist() if item.shape else [item[()].item() if hasattr(item[()], "item") else item[()]]
            about.update(shape=list(item.shape), values=[plain(value) for value in values])
        found["/" + name] = about

    with h5py.File(path, "r") as file:
        found["/"] = {key: plain(value) for key, value in file.attrs.items()}
        file.visititems(visit)
    return found


class Vtk:
    """A file of VTK's XML with raw appended data; counts of points, cells and values must agree, as in VTK."""

    def __init__(self, path, kind):
        with open(path, "rb") as file:
            text = file.read()
        head, mark, rest = text.partition(b'<AppendedData encoding="raw">')
        if not mark:
            raise ValueError(f"{path}: no appended data")
        root = xml.fromstring(head + b"</VTKFile>")
        if root.get("type") != kind or root.get("header_type") != "UInt64":
            raise ValueError(f"{path}: not a {kind} with lengths of 64 bits")
        self.order = {"LittleEndian": "<", "BigEndian": ">"}[root.get("byte_order")]
        self.data = rest[rest.index(b"_") + 1:]
        self.whole = root.find(kind)
        self.piece = self.whole.find("Piece")
        self.end = 0
        self.path = path

    def arrays(self, of, count):
        """{name: values} below an element; an array of several components has a list for each of `count` places."""
        return {array.get("Name"): self.values(array, count) for array in self.piece.find(of)}

    def values(self, array, count):
        offset, components = int(array.get("offset")), int(array.get("NumberOfComponents"))
        size, = struct.unpack_from(self.order + "Q", self.data, offset)
        if size != 8 * components * count:
            raise ValueError(f"{self.path}: {array.get('Name')} has {size} bytes, not {count} times {components} numbers")
        self.end = max(self.end, offset + 8 + size)
        numbers = [plain(value) for value in
                   struct.unpack_from(f"{self.order}{components * count}{TYPES[array.get('type')]}", self.data, offset + 8)]
        return numbers if components == 1 else [numbers[i:i + components] for i in range(0, len(numbers), components)]

    def check_end(self):
        if self.data[self.end:].split() != [b"</AppendedData>", b"</VTKFile>"]:
            raise ValueError(f"{self.path}: bytes that no array has")


def polylines(path):
    """The values at the points, and the points of each line."""
    file = Vtk(path, "PolyData")
    points, lines = (int(file.piece.get("NumberOf" + what)) for what in ("Points", "Lines"))
    places = file.arrays("Points", points)["Points"]
    of_points = file.arrays("PointData", points)
    offsets = file.values(file.piece.find("Lines/DataArray[@Name='offsets']"), lines)
    if offsets != sorted(offsets):
        raise ValueError(f"{path}: a line ends before it begins")
    order = file.values(file.piece.find("Lines/DataArray[@Name='connectivity']"), offsets[-1])
    file.check_end()
    lines = [order[begin:end] for begin, end in zip([0] + offsets, offsets)]
    return [{"points": [places[i] for i in line], **{name: [values[i] for i in line] for name, values in of_points.items()}}
            for line in lines]


def grid(path):
    """A structured grid of one layer: for each cell its values and its corners, around it."""
    file = Vtk(path, "StructuredGrid")
    extent = [int(word) for word in file.piece.get("Extent").split()]
    if extent != [int(word) for word in file.whole.get("WholeExtent").split()] or extent[4:] != [0, 0]:
        raise ValueError(f"{path}: not one piece of one layer")
    across, along = extent[1] - extent[0] + 1, extent[3] - extent[2] + 1
    places = file.arrays("Points", across * along)["Points"]
    of_points, of_cells = file.arrays("PointData", across * along), file.arrays("CellData", (across - 1) * (along - 1))
    file.check_end()
    cells = []
    for k in range((across - 1) * (along - 1)):
        first = k // (across - 1) * across + k % (across - 1)
        corners = [first, first + 1, first + across + 1, first + across]
        cells.append({"corners": [places[c] for c in corners], "potential": [of_points["potential"][c] for c in corners],
                      **{name: values[k] for name, values in of_cells.items()}})
    return cells


def frames(folder):
    """Time and polylines of each frame that shapes.pvd names."""
    return [{"time": float(part.get("timestep")), "lines": polylines(os.path.join(folder, part.get("file")))}
            for part in xml.parse(os.path.join(folder, "shapes.pvd")).getroot().find("Collection")]


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


READERS = {"results.h5": lambda folder: hdf5(os.path.join(folder, "results.h5")), "shapes.pvd": frames,
           "field.vts": lambda folder: grid(os.path.join(folder, "field.vts")),
           "table.csv": lambda folder: table(os.path.join(folder, "table.csv"))}

folder = sys.argv[1]
json.dump({name: read(folder) for name, read in READERS.items() if os.path.exists(os.path.join(folder, name))}, sys.stdout)
