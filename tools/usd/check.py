#!/usr/bin/env python3
"""Checks USD files with usd-core's own validators and groomkit's rules for hair curves.

Exit 0: nothing wrong. 1: errors or warnings. 2: a file could not be opened.
"""

import argparse
import dataclasses
import json
import sys

from whole_file import missing_usd_core

try:
    from pxr import Tf, Usd, UsdValidation

    from curve_rules import Finding, check_stage
except ImportError:
    if __name__ == "__main__":
        sys.exit(missing_usd_core())
    raise

SEVERITIES = {
    UsdValidation.ValidationErrorType.Error: "error",
    UsdValidation.ValidationErrorType.Warn: "warning",
    UsdValidation.ValidationErrorType.Info: "info",
}
# These judge .usdz packages, which a single layer is not.
PACKAGE_VALIDATORS = {
    "usdUtilsValidators:FileExtensionValidator",
    "usdUtilsValidators:PackageEncapsulationValidator",
    "usdUtilsValidators:RootPackageValidator",
    "usdUtilsValidators:UsdzPackageValidator",
}

# Nodes of renderers and of MaterialX are in no registry of the bare wheel.
FOREIGN_NODES = ("ND_", "Pxr", "arnold:")


def run_validators(stage, is_package):
    """Yields what the validators of usd-core find."""
    registry = UsdValidation.ValidationRegistry()
    names = [metadata.name for metadata in registry.GetAllValidatorMetadata()]
    wanted = [name for name in names if is_package or name not in PACKAGE_VALIDATORS]
    validators = [registry.GetOrLoadValidatorByName(name) for name in wanted]
    for found in UsdValidation.ValidationContext(validators).Validate(stage):
        rule = f"{found.GetValidator().GetMetadata().name}.{found.GetName()}"
        places = ", ".join(_place(site) for site in found.GetSites())
        severity = SEVERITIES.get(found.GetType(), "error")
        if found.GetName() == "MissingShaderIdInRegistry" and _is_foreign(found):
            severity = "info"
        yield Finding(severity, rule, places or "/", found.GetMessage())


def _is_foreign(found):
    """Whether the shader belongs to a renderer whose nodes usd-core does not know."""
    return any(f"'{start}" in found.GetMessage() for start in FOREIGN_NODES)


def _place(site):
    if site.IsProperty():
        return str(site.GetProperty().GetPath())
    if site.IsPrim():
        return str(site.GetPrim().GetPath())
    return "/"


def check_file(path):
    """All findings about the file at `path`."""
    stage = Usd.Stage.Open(path)
    return [*run_validators(stage, path.endswith(".usdz")), *check_stage(stage)]


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE", nargs="+", help=".usda, .usdc, .usd or .usdz")
    parser.add_argument("--json", action="store_true", help="print the findings as JSON")
    options = parser.parse_args(arguments)
    report, wanting = {}, False
    for path in options.files:
        try:
            findings = check_file(path)
        except Tf.ErrorException as error:
            print(f"error: {path}: {error}", file=sys.stderr)
            return 2
        wanting |= any(finding.severity != "info" for finding in findings)
        report[path] = [dataclasses.asdict(finding) for finding in findings]
        if not options.json:
            print(f"{path}: {len(findings)} findings")
            for finding in findings:
                print(f"  {finding.severity} {finding.rule} <{finding.place}> {finding.message}")
    if options.json:
        json.dump(report, sys.stdout, indent=1)
        print()
    return int(wanting)


if __name__ == "__main__":
    sys.exit(main())
