#!/usr/bin/env python3
"""Loads strand files of text in Mitsuba 3, as linear and as B-spline curves, and counts what comes out.

    load.py STRANDS:POINTS:FILE...

STRANDS and POINTS are what FILE must hold. Mitsuba wants strands of two points for `linearcurve` and of four for
`bsplinecurve`; the second is left out for files with shorter strands.

Exit status: 0 everything loaded with the counts that were promised, 1 something did not, 2 could not look
(no Mitsuba, no file); "skip" on standard output says that Mitsuba is missing.
"""
import sys


def shortest(path):
    """Points of the shortest strand."""
    counts, points = [], 0
    for line in open(path):
        if line.split():
            points += 1
        elif points:
            counts.append(points)
            points = 0
    return min(counts + [points] if points else counts)


def control_points(shape, mi):
    """Points of a loaded shape: four floats each."""
    return len(mi.traverse(shape)["control_points"]) // 4


def segments(shape, mi):
    return len(mi.traverse(shape)["segment_indices"])


def main(arguments):
    if not arguments:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        import mitsuba as mi
    except ImportError as error:
        print(f"skip: {error}")
        return 2
    mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() else "scalar_rgb")
    wrong = 0
    for argument in arguments:
        try:
            strands, points, path = argument.split(":", 2)
            strands, points, least = int(strands), int(points), shortest(path)
        except (ValueError, OSError) as error:
            print(f"{argument}: {error}", file=sys.stderr)
            return 2
        # Spans of a strand: one less than its points, and three less for a B-spline.
        for kind, needed in [("linearcurve", 2), ("bsplinecurve", 4)]:
            if least < needed:
                print(f"{path}: {kind} left out, a strand has {least} points")
                continue
            try:
                shape = mi.load_dict({"type": kind, "filename": path})
                found = (control_points(shape, mi), segments(shape, mi))
            except Exception as error:  # whatever Mitsuba says is a fault of the file
                print(f"{path}: {kind}: {error}")
                wrong = 1
                continue
            expected = (points, points - (needed - 1) * strands)
            if found != expected:
                print(f"{path}: {kind}: found {found} points and segments, expected {expected}")
                wrong = 1
            else:
                print(f"{path}: {kind}: {found[0]} points, {found[1]} segments")
    return wrong


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
