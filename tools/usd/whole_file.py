"""Output files that are whole or not there, and the message for a missing usd-core."""

import contextlib
import os
import sys
import tempfile

INSTALL = "python3 -m pip install -r tools/usd/requirements.txt"


def missing_usd_core():
    """Says how to install usd-core; the exit code for it."""
    print(f"error: usd-core is not installed for {sys.executable}; install it with: {INSTALL}", file=sys.stderr)
    return 2


@contextlib.contextmanager
def whole_file(path):
    """A temporary name beside `path`, with its ending; takes its place unless an error passes by."""
    folder, name = os.path.split(os.path.abspath(path))
    with tempfile.TemporaryDirectory(prefix=f".{name}.", dir=folder) as temporary:
        inside = os.path.join(temporary, name)
        yield inside
        with open(inside, "rb") as file:
            os.fsync(file.fileno())
        os.chmod(inside, 0o644)
        os.replace(inside, path)
