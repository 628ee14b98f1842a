# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the reference of filters, from headers and ParaView's XML, and that of the command line, from its manual page.

`write` is called where the site is built.
"""

import pathlib
import re
import subprocess
import xml.etree.ElementTree as ElementTree


def one_line(text):
    return " ".join((text or "").split())


def in_table(text):
    return re.sub(r"([|*_<>])", r"\\\1", one_line(text))


def brief(headers, name):
    """What the class is, by the comment above it."""
    if name not in headers:
        return ""
    found = re.search(r"@brief\s+(.*?)\n \*\s*\n", headers[name].read_text(), re.DOTALL)
    return one_line(found.group(1).replace("\n * ", " ")) if found else ""


def value_range(element):
    """The default as a user sees it, and what else a property can be."""
    default = element.get("default_values", "")
    entries = {entry.get("value"): entry.get("text") for entry in element.findall("EnumerationDomain/Entry")}
    if entries:
        return entries.get(default, default), ", ".join(entries.values())
    if element.find("BooleanDomain") is not None:
        return {"0": "off", "1": "on"}.get(default, default), "on, off"
    bounds = next((domain for domain in element if domain.tag.endswith("RangeDomain") and (domain.get("min") or domain.get("max"))), None)
    if bounds is None:
        return default, ""
    low, high = bounds.get("min"), bounds.get("max")
    return default, f"{low} to {high}" if low and high else f"from {low}" if low else f"to {high}"


class Reference:
    """Proxies by group and name; a proxy has the properties of its base ahead of its own."""

    def __init__(self, source):
        self.headers = {path.stem: path for folder in ("Filters", "IO") for path in (source / folder).rglob("vtkAtria*.h")}
        self.proxies = {}
        for path in sorted((source / "ParaViewPlugin").glob("*.xml")):
            root = ElementTree.parse(path).getroot()
            for group in root.iter("ProxyGroup"):
                for proxy in group:
                    if proxy.get("class", "").startswith("vtkAtria"):
                        self.proxies[group.get("name"), proxy.get("name")] = proxy

    def properties(self, proxy):
        base = self.proxies.get((proxy.get("base_proxygroup"), proxy.get("base_proxyname")))
        inherited = self.properties(base) if base is not None else {}
        own = {child.get("name"): child for child in proxy if child.tag.endswith("VectorProperty")}
        return {**inherited, **own}

    def page(self):
        lines = ["# Filters, readers and writers", "",
                 "Generated from the public headers and from ParaView's XML. Lengths are in meters, angles in degrees. Set a property "
                 "in C++ and Python by `Set` and its name; headers tell of methods beside these.", ""]
        shown = [proxy for (group, _), proxy in self.proxies.items() if not group.startswith("internal")]
        for proxy in sorted(shown, key=lambda proxy: proxy.get("label") or proxy.get("name")):
            lines += self.section(proxy)
        return "\n".join(lines)

    def section(self, proxy):
        name = proxy.get("class")
        lines = [f"## {proxy.get('label') or proxy.get('name')}", "", f"`{name}`: {brief(self.headers, name)}.", ""]
        lines += [one_line(proxy.findtext("Documentation")), ""]
        for kind, title in (("InputProperty", "Inputs"), ("OutputPort", "Outputs")):
            ports = [port.get("name") for port in proxy.findall(kind)]
            if ports:
                lines += [f"{title}: " + ", ".join(f"*{port}*" for port in ports) + ".", ""]
        rows = [self.row(element) for element in self.properties(proxy).values() if element.get("panel_visibility") != "never"]
        if rows:
            lines += ["| property | default | range | meaning |", "|---|---|---|---|", *rows, ""]
        return lines

    def row(self, element):
        default, values = value_range(element)
        cells = [f"`{element.get('name')}`", in_table(default), in_table(values), in_table(element.findtext("Documentation"))]
        return "| " + " | ".join(cells) + " |"


def commands_page(manual):
    """Markdown of the manual page that `atria man` prints."""
    lines = ["# Command line", "", "Generated from the options of `atria`. `atria COMMAND --help` prints the same.", ""]
    entry = False
    for line in manual.splitlines():
        text = re.sub(r"\\f[BIR]|\\&", "", line).replace("\\-", "-").replace("\\e", "\\")
        heading = re.match(r"\.S([HS]) (.*)", text)
        if line == ".TP":
            entry = True
        elif heading:
            kind, title = heading.groups()
            command = re.sub(r"^ATRIA (\w+)$", r"`atria \1`", title)
            lines += ["", ("## " if kind == "H" else "### ") + (command if command != title else title.capitalize()), ""]
        elif entry:
            lines += ["", f"`{text}`"]
            entry = False
        elif re.match(r"\.(nf|EX)", line):
            lines += ["", "```"]
        elif re.match(r"\.(fi|EE)", line):
            lines += ["```", ""]
        elif line.startswith("."):
            lines += [""]
        elif lines[-1].startswith("`-") or lines[-1].startswith("`") and not lines[-1].startswith("```"):
            lines += [f": {text}"]
        else:
            lines += [text]
    return "\n".join(lines) + "\n"


def write(source, atria, folder):
    """The pages filters.md and commands.md in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "filters.md").write_text(Reference(source).page())
    manual = subprocess.run([atria, "man"], capture_output=True, text=True, check=True).stdout
    (folder / "commands.md").write_text(commands_page(manual))
