#!/usr/bin/env python3
"""Prints what usd-core finds in layers as a JSON list: metadata, and every attribute with its type, interpolation
and samples. Arrays of 32-bit numbers are 8 hexadecimal digits a value; the time of a value for all times is null."""

import json
import sys

import numpy as np
from pxr import Usd


def plain(value):
    """A value in words that JSON has."""
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    array = np.ascontiguousarray(value)
    if array.dtype.kind in "iuf" and array.dtype.itemsize == 4:
        return array.view(np.uint32).astype(">u4").tobytes().hex()
    return [plain(item) for item in value]


def attribute_of(attribute):
    times = attribute.GetTimeSamples()
    values = [[time, plain(attribute.Get(time))] for time in times]
    return {
        "type": str(attribute.GetTypeName()),
        "uniform": str(attribute.GetVariability()) == "Sdf.VariabilityUniform",
        "interpolation": attribute.GetMetadata("interpolation"),
        "samples": values or [[None, plain(attribute.Get())]],
        "connections": [str(path) for path in attribute.GetConnections()],
    }


def prim_of(prim):
    attributes = [attribute for attribute in prim.GetAttributes() if attribute.IsAuthored()]
    relationships = prim.GetRelationships()
    schemas = prim.GetMetadata("apiSchemas")
    return {
        "type": str(prim.GetTypeName()),
        "kind": prim.GetMetadata("kind"),
        "schemas": list(schemas.GetAddedOrExplicitItems()) if schemas else [],
        "attributes": {attribute.GetName(): attribute_of(attribute) for attribute in attributes},
        "relationships": {r.GetName(): [str(path) for path in r.GetTargets()] for r in relationships if r.IsAuthored()},
    }


def stage_of(path):
    stage = Usd.Stage.Open(path)
    names = ("defaultPrim", "upAxis", "metersPerUnit", "timeCodesPerSecond", "framesPerSecond")
    names += ("startTimeCode", "endTimeCode", "documentation")
    return {
        "metadata": {name: stage.GetMetadata(name) for name in names if stage.HasAuthoredMetadata(name)},
        "prims": {str(prim.GetPath()): prim_of(prim) for prim in stage.TraverseAll()},
    }


if __name__ == "__main__":
    json.dump([stage_of(path) for path in sys.argv[1:]], sys.stdout)
