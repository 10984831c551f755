"""Numbers of .npy files of version 1, without numpy."""

import array
import ast
import struct
import sys

CODES = {"<f8": "d", "<f4": "f", "<u2": "H"}


def read(path):
    """The shape and all numbers of a .npy file, in its order."""
    with open(path, "rb") as file:
        magic, version = file.read(6), file.read(2)
        if magic != b"\x93NUMPY" or version[0] != 1:
            sys.exit(f"{path}: no .npy file of version 1")
        (length,) = struct.unpack("<H", file.read(2))
        header = ast.literal_eval(file.read(length).decode("latin1"))
        if header["descr"] not in CODES:
            sys.exit(f"{path}: numbers of type {header['descr']}\n  expected: {', '.join(CODES)}")
        values = array.array(CODES[header["descr"]])
        values.frombytes(file.read())
        return header["shape"], values
