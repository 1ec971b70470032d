"""Holds documents against a JSON Schema with the Python package jsonschema.

    check_schema.py SCHEMA < DOCUMENTS

DOCUMENTS is a JSON list; the answer, on standard output, is a JSON list with the faults of each: where and what.
"""

import json
import sys

from jsonschema import Draft202012Validator

with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)


def innermost(error):
    """The fault of the kind of value that was most likely meant."""
    while error.context:
        error = max(error.context, key=lambda below: (len(below.absolute_path), below.validator != "type"))
    return f"{error.json_path}: {error.message}"


documents = json.load(sys.stdin)
json.dump([[innermost(error) for error in validator.iter_errors(document)] for document in documents], sys.stdout)
