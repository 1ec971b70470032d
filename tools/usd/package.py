#!/usr/bin/env python3
"""Packs a layer and all it refers to into one .usdz. Exit 0: done. 2: could not."""

import argparse
import sys

from whole_file import missing_usd_core, whole_file

try:
    from pxr import Sdf, Tf, UsdUtils
except ImportError:
    if __name__ == "__main__":
        sys.exit(missing_usd_core())
    raise


def package(source, target):
    """Packs `source` into `target`; raises `Tf.ErrorException` or `OSError`."""
    # A layer that is not there is told before anything is written.
    if not Sdf.Layer.FindOrOpen(source):
        raise OSError("no such layer")
    if not UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(source), target):
        raise OSError("usd-core made no package of it")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", metavar="IN", help=".usda, .usdc or .usd")
    parser.add_argument("target", metavar="OUT.usdz")
    options = parser.parse_args(arguments)
    if not options.target.endswith(".usdz"):
        print(f"error: {options.target}: expected a name that ends in .usdz", file=sys.stderr)
        return 2
    try:
        with whole_file(options.target) as temporary:
            package(options.source, temporary)
    except (Tf.ErrorException, OSError) as error:
        print(f"error: {options.source}: {error}", file=sys.stderr)
        return 2
    print(options.target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
