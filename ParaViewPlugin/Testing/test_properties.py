# SPDX-License-Identifier: GPL-3.0-or-later
"""The server manager's XML says what the C++ classes do: every property, its default, range and unit.

Usage: pvpython test_properties.py FOLDER_OF_XML
"""

import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

from paraview import servermanager

import atria
from house_pipeline import load_plugin

VECTORS = {"IntVectorProperty", "DoubleVectorProperty", "StringVectorProperty", "IdTypeVectorProperty"}
UNITS = re.compile(r"meters|seconds|degrees|gigabytes|no unit")
# Values beyond which a limit of a C++ range means "no limit".
UNLIMITED = 1e30
INT_MAX = 2**31 - 1
# Set in C++ by methods that have no getter.
WITHOUT_GETTER = {"Seeds", "SealedSeeds"}

# In ParaView sizes follow from the model until a user enters some. In C++ they do so where they are set to 0.
FROM_THE_MODEL = {"SizeMax", "SizeMid", "SizeMin"}

# Set by ParaView itself, on each rank.
SET_BY_RANK = {"NumberOfPieces", "Piece"}

# Groups of proxies that are made of ParaView's classes, for views and panels.
ONLY_PARAVIEW = {"representations", "misc"}

# What others inherit.
ABSTRACT = {"AtriaGrid", "AtriaSurfaces"}


def read_proxies(folder):
    """{name: (class, element, [property elements, inherited ones first])}"""
    elements = {}
    for file in sorted(pathlib.Path(folder).glob("*.xml")):
        for group in ElementTree.parse(file).getroot():
            if group.get("name") in ONLY_PARAVIEW:
                continue
            for proxy in group:
                proxy.set("group", group.get("name"))
                elements[proxy.get("name")] = proxy
    result = {}
    for name, proxy in elements.items():
        base = elements.get(proxy.get("base_proxyname"))
        properties = {}
        for source in (base, proxy):
            if source is not None:
                # Stated again, a property replaces the inherited one.
                properties.update({e.get("name"): e for e in source if e.tag.endswith("Property")})
        result[name] = (proxy.get("class"), proxy, list(properties.values()))
    return result


def value_of(element, text):
    convert = {"IntVectorProperty": int, "DoubleVectorProperty": float}.get(element.tag, str)
    values = [convert(word) for word in text.split()] if convert is not str else [text]
    return values


def cpp_default(instance, element):
    value = getattr(instance, "Get" + element.get("command")[3:])()
    if value is None:
        return [""]
    return list(value) if isinstance(value, tuple) else [value]


def check_default(instance, element, where, complain):
    stated = element.get("default_values")
    if stated is None:
        return
    if not hasattr(instance, "Get" + element.get("command")[3:]):
        complain(f"{where}: C++ has no such property")
        return
    stated = value_of(element, stated)
    actual = cpp_default(instance, element) if element.get("name") not in FROM_THE_MODEL else [0.0]
    if stated != [type(s)(a) for s, a in zip(stated, actual)] or len(stated) != len(actual):
        complain(f"{where}: XML default {stated}, C++ {actual}")


def check_range(instance, element, where, complain):
    name = element.get("command")[3:]
    if not hasattr(instance, f"Get{name}MinValue"):
        return
    limits = [getattr(instance, f"Get{name}{end}Value")() for end in ("Min", "Max")]
    limits[0] = None if limits[0] <= -UNLIMITED else limits[0]
    limits[1] = None if limits[1] >= UNLIMITED or limits[1] == INT_MAX else limits[1]
    domain = next((e for e in element if e.tag.endswith("RangeDomain")), None)
    entries = [int(e.get("value")) for e in element.iter("Entry")]
    if entries:
        stated = [min(entries), max(entries)]
    elif domain is not None:
        stated = [float(domain.get(end)) if domain.get(end) else None for end in ("min", "max")]
    else:
        stated = [None, None]
    if stated != limits:
        complain(f"{where}: XML range {stated}, C++ {limits}")


def check_documentation(element, where, complain):
    text = element.findtext("Documentation") or ""
    if not text.strip():
        complain(f"{where}: no Documentation")
    elif element.tag == "DoubleVectorProperty" and not UNITS.search(text):
        complain(f"{where}: its Documentation names no unit")


def check_all_there(instance, properties, where, complain):
    """Every pair of Set and Get of Atria's own classes is a property."""
    known = SET_BY_RANK | {e.get("command", "")[3:] for e in properties}
    known |= {"NumberOf" + e.get("name") for e in properties if e.get("repeat_command") == "1"}
    for cls in type(instance).__mro__:
        if not cls.__name__.startswith("vtkAtria"):
            continue
        for method in vars(cls):
            stem = method[3:]
            if method.startswith("Set") and hasattr(instance, "Get" + stem) and stem not in known:
                complain(f"{where}: C++ property {stem} is missing in the XML")


def check_ports(name, proxy, complain):
    live = servermanager.ProxyManager().NewProxy(proxy.get("group"), name)
    if live is None:
        complain(f"{name}: ParaView cannot make it")
        return
    live.UpdateVTKObjects()
    if proxy.tag == "WriterProxy":
        return
    stated = [port.get("name") for port in proxy.findall("OutputPort")]
    actual = [live.GetOutputPortName(i) for i in range(live.GetNumberOfOutputPorts())]
    if stated != actual:
        complain(f"{name}: output ports {actual}, expected {stated}")


def main(folder):
    load_plugin()
    complaints = []
    proxies = read_proxies(folder)
    assert len(proxies) >= 5
    for name, (class_name, proxy, properties) in proxies.items():
        if name in ABSTRACT:
            continue # its properties are checked in the proxies that inherit them
        instance = getattr(atria, class_name)()
        for element in properties:
            where = f"{name}.{element.get('name')}"
            check_documentation(element, where, complaints.append)
            if element.tag in VECTORS and element.get("information_only") != "1" and element.get("name") not in WITHOUT_GETTER:
                check_default(instance, element, where, complaints.append)
                check_range(instance, element, where, complaints.append)
        check_all_there(instance, properties, name, complaints.append)
        check_ports(name, proxy, complaints.append)
    for complaint in complaints:
        print(complaint, file=sys.stderr)
    sys.exit(1 if complaints else 0)


main(sys.argv[1])
