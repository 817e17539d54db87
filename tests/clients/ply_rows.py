"""Reads what the tools write as binary PLY: the judge of translate.py, apart from the library."""

import re
import struct

import numpy as np

TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
         "float": "<f4", "double": "<f8"}
for size, names in ((8, ("char", "uchar")), (16, ("short", "ushort")), (32, ("int", "uint"))):
    for short in names:
        TYPES[("uint" if short[0] == "u" else "int") + str(size)] = TYPES[short]
TYPES |= {"float32": "<f4", "float64": "<f8"}


def rows_one_by_one(data, at, count, properties):
    """Columns of rows whose lists differ in length: a list of tuples for each list."""
    columns = {name: [] for name, _, _ in properties}
    for _ in range(count):
        for name, kind, length in properties:
            many = 1
            if length:
                (many,) = np.frombuffer(data, length, 1, at)
                at += np.dtype(length).itemsize
            values = np.frombuffer(data, kind, int(many), at)
            at += values.nbytes
            columns[name].append(tuple(values.tolist()) if length else values[0])
    return {name: columns[name] if length else np.array(columns[name])
            for name, _, length in properties}, at


def rows(data, at, count, properties):
    """Columns of `count` rows at `at`, and where the next element is."""
    fields, ahead = [], at
    for name, kind, length in properties:
        many = ()
        if length:
            if count == 0:
                return {name: [] for name, _, _ in properties}, at
            many = (int(np.frombuffer(data, length, 1, ahead)[0]),)
            fields.append((name + " length", length))
            ahead += np.dtype(length).itemsize
        fields.append((name, kind, many))
        ahead += np.dtype(kind).itemsize * (many[0] if many else 1)
    whole = np.dtype(fields)
    if at + count * whole.itemsize <= len(data):
        table = np.frombuffer(data, whole, count, at)
        if all((table[name + " length"] == table[name].shape[1]).all()
               for name, _, length in properties if length):
            return ({name: list(map(tuple, table[name].tolist())) if length else table[name]
                     for name, _, length in properties}, at + table.nbytes)
    return rows_one_by_one(data, at, count, properties)


def read_ply(path):
    """Elements by name, each a dictionary of columns; and the lines of the header."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header\n") + len("end_header\n")
    header = data[:end].decode(errors="replace").splitlines()
    elements = []
    order = ">" if "format binary_big_endian 1.0" in header else "<"
    type_of = lambda word: TYPES[word].replace("<", order)
    for line in header:
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append((words[-1], type_of(words[-2]),
                                    type_of(words[2]) if words[1] == "list" else ""))
    made, at = {}, end
    for name, count, properties in elements:
        made[name], at = rows(data, at, count, properties)
    return made, header
