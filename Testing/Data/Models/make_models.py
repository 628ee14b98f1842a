#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes one small house, 8 by 6 m with a gable roof and an open door, in the formats of architects' programs.

It is `sampleHouse` of Testing/IO/ModelSamples.cxx. Formats that have units are in some other than the meter where it is
exact. In the IFC file each surface is an element of one of two storeys.

Usage: make_models.py [FOLDER]    (default: the folder of this script)
"""

import json
import pathlib
import struct
import sys

SURFACES = [
    ("Front", "Brick", [[(0, 0, 0), (2, 0, 0), (2, 0, 2.5), (3.5, 0, 2.5), (3.5, 0, 0), (8, 0, 0), (8, 0, 4), (0, 0, 4)]]),
    ("Back", "Brick", [[(8, 6, 0), (0, 6, 0), (0, 6, 4), (8, 6, 4)]]),
    ("Left", "Brick", [[(0, 6, 0), (0, 0, 0), (0, 0, 4), (0, 3, 6), (0, 6, 4)]]),
    ("Right", "Brick", [[(8, 0, 0), (8, 6, 0), (8, 6, 4), (8, 3, 6), (8, 0, 4)]]),
    ("Roof", "Tiles", [[(0, 0, 4), (8, 0, 4), (8, 3, 6), (0, 3, 6)], [(8, 6, 4), (0, 6, 4), (0, 3, 6), (8, 3, 6)]]),
    ("Floor", "", [[(0, 0, 0), (0, 6, 0), (8, 6, 0), (8, 0, 0)]]),
]
MATERIALS = ["Brick", "Tiles"]
# The front is concave: what takes triangles alone gets these of its corners. All others are convex.
FRONT = [(0, 1, 2), (0, 2, 7), (2, 3, 7), (3, 6, 7), (3, 4, 5), (3, 5, 6)]


def indexed(polygons):
    """Points without repetition, and the polygons by their numbers."""
    points = list(dict.fromkeys(p for polygon in polygons for p in polygon))
    return points, [[points.index(p) for p in polygon] for polygon in polygons]


def triangles(name, polygons):
    for polygon in polygons:
        for corners in FRONT if name == "Front" else [(0, i, i + 1) for i in range(1, len(polygon) - 1)]:
            yield [polygon[i] for i in corners]


def numbers(values):
    return " ".join(f"{value:g}" for value in values)


def collada():
    """In half meters, y up."""
    geometries, nodes = [], []
    for i, (name, material, polygons) in enumerate(SURFACES):
        points, faces = indexed(polygons)
        values = [2 * v for x, y, z in points for v in (x, z, -y)]
        symbol = ' material="symbol"' if material else ""
        geometries.append(
            f'<geometry id="g{i}"><mesh><source id="g{i}p"><float_array id="g{i}a" count="{len(values)}">{numbers(values)}'
            f'</float_array><technique_common><accessor source="#g{i}a" count="{len(points)}" stride="3">'
            '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>'
            f'</technique_common></source><vertices id="g{i}v"><input semantic="POSITION" source="#g{i}p"/></vertices>'
            f'<polylist{symbol} count="{len(faces)}"><input semantic="VERTEX" source="#g{i}v" offset="0"/>'
            f'<vcount>{numbers(map(len, faces))}</vcount><p>{numbers(k for face in faces for k in face)}</p></polylist></mesh></geometry>')
        bound = (f'<bind_material><technique_common><instance_material symbol="symbol" target="#{material}"/></technique_common>'
                 "</bind_material>" if material else "")
        nodes.append(f'<node id="ID{i}" name="{name}"><instance_geometry url="#g{i}">{bound}</instance_geometry></node>')
    materials = "\n".join(f'<material id="{m}" name="{m}"><instance_effect url="#effect"/></material>' for m in MATERIALS)
    return ('<?xml version="1.0" encoding="utf-8"?>\n'
            '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
            '<asset><unit name="half" meter="0.5"/><up_axis>Y_UP</up_axis></asset>\n'
            '<library_effects><effect id="effect"><profile_COMMON><technique sid="t"><phong/></technique></profile_COMMON></effect>'
            f"</library_effects>\n<library_materials>\n{materials}\n</library_materials>\n<library_geometries>\n"
            + "\n".join(geometries) + '\n</library_geometries>\n<library_visual_scenes><visual_scene id="scene">\n'
            + "\n".join(nodes) + '\n</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#scene"/></scene>\n</COLLADA>\n')


def chunk(identifier, content):
    return struct.pack("<HI", identifier, 6 + len(content)) + content


def three_ds():
    """Triangles alone, no unit, z up."""
    text = lambda word: word.encode() + b"\0"
    editor = b"".join(chunk(0xAFFF, chunk(0xA000, text(name))) for name in MATERIALS)
    for name, material, polygons in SURFACES:
        points, faces = indexed(list(triangles(name, polygons)))
        vertices = struct.pack("<H", len(points)) + b"".join(struct.pack("<3f", *p) for p in points)
        of_material = chunk(0x4130, text(material) + struct.pack(f"<{1 + len(faces)}H", len(faces), *range(len(faces)))) if material else b""
        corners = struct.pack("<H", len(faces)) + b"".join(struct.pack("<4H", *face, 0) for face in faces)
        editor += chunk(0x4000, text(name) + chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, corners + of_material)))
    frames = b"".join(
        chunk(0xB002, chunk(0xB030, struct.pack("<H", i)) + chunk(0xB010, text(name) + struct.pack("<3H", 0, 0, 0xFFFF)))
        for i, (name, _, _) in enumerate(SURFACES))
    return chunk(0x4D4D, chunk(0x0002, struct.pack("<I", 3)) + chunk(0x3D3D, editor) + chunk(0xB000, frames))


def fbx():
    """ASCII, in meters (units of a hundred centimeters), z up."""
    objects, connections = [], []
    of_material = ('\t\tLayerElementMaterial: 0 {\n\t\t\tVersion: 101\n\t\t\tName: ""\n\t\t\tMappingInformationType: "AllSame"\n'
                   '\t\t\tReferenceInformationType: "IndexToDirect"\n\t\t\tMaterials: *1 {\n\t\t\t\ta: 0\n\t\t\t}\n\t\t}\n'
                   '\t\tLayer: 0 {\n\t\t\tVersion: 100\n\t\t\tLayerElement:  {\n\t\t\t\tType: "LayerElementMaterial"\n'
                   '\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n')
    for i, material in enumerate(MATERIALS):
        objects.append(f'\tMaterial: {900 + i}, "Material::{material}", "" {{\n\t\tVersion: 102\n\t\tShadingModel: "phong"\n'
                       "\t\tMultiLayer: 0\n\t}\n")
    for i, (name, material, polygons) in enumerate(SURFACES):
        points, faces = indexed(polygons)
        values = [v for p in points for v in p]
        corners = [k for face in faces for k in face[:-1] + [~face[-1]]]
        joined = lambda entries: ",".join(f"{entry:g}" for entry in entries)
        objects.append(f'\tGeometry: {100 + i}, "Geometry::{name}", "Mesh" {{\n\t\tVertices: *{len(values)} {{\n'
                       f"\t\t\ta: {joined(values)}\n\t\t}}\n\t\tPolygonVertexIndex: *{len(corners)} {{\n\t\t\ta: {joined(corners)}\n"
                       f"\t\t}}\n\t\tGeometryVersion: 124\n{of_material if material else ''}\t}}\n"
                       f'\tModel: {200 + i}, "Model::{name}", "Mesh" {{\n\t\tVersion: 232\n\t}}\n')
        connections += [f'\tC: "OO",{200 + i},0\n\tC: "OO",{100 + i},{200 + i}\n']
        if material:
            connections.append(f'\tC: "OO",{900 + MATERIALS.index(material)},{200 + i}\n')
    axes = "".join(f'\t\tP: "{key}", "int", "Integer", "",{value}\n' for key, value in (
        ("UpAxis", 2), ("UpAxisSign", 1), ("FrontAxis", 1), ("FrontAxisSign", -1), ("CoordAxis", 0), ("CoordAxisSign", 1)))
    return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
            f"GlobalSettings:  {{\n\tVersion: 1000\n\tProperties70:  {{\n{axes}"
            '\t\tP: "UnitScaleFactor", "double", "Number", "",100\n\t}\n}\n'
            f"Objects:  {{\n{''.join(objects)}}}\nConnections:  {{\n{''.join(connections)}}}\n")


def dxf():
    """Triangles on layers, in meters, z up."""
    lines = ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "6", "0", "ENDSEC", "0", "SECTION", "2", "ENTITIES"]
    for name, _, polygons in SURFACES:
        for corners in triangles(name, polygons):
            lines += ["0", "3DFACE", "8", name]
            for i, p in enumerate([*corners, corners[2]]):
                for axis in range(3):
                    lines += [str(10 * (axis + 1) + i), f"{p[axis]:g}"]
    return "\n".join([*lines, "0", "ENDSEC", "0", "EOF"]) + "\n"


def ifc():
    """In millimeters, z up."""
    entities = []

    def add(text):
        entities.append(f"#{len(entities) + 1}={text};")
        return f"#{len(entities)}"

    identifiers = iter(f"{i:022d}" for i in range(100))
    owner = add("IFCOWNERHISTORY($,$,$,.ADDED.,$,$,$,0)")
    origin = add("IFCCARTESIANPOINT((0.,0.,0.))")
    axes = add(f"IFCAXIS2PLACEMENT3D({origin},$,$)")
    place = add(f"IFCLOCALPLACEMENT($,{axes})")
    context = add(f"IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,{axes},$)")
    unit = add("IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)")
    units = add(f"IFCUNITASSIGNMENT(({unit}))")
    root = lambda name: f"'{next(identifiers)}',{owner},'{name}',$"
    project = add(f"IFCPROJECT({root('Project')},$,$,$,({context}),{units})")
    building = add(f"IFCBUILDING({root('House')},$,{place},$,$,.ELEMENT.,$,$,$)")
    storeys = {name: add(f"IFCBUILDINGSTOREY({root(name)},$,{place},$,$,.ELEMENT.,{level}.)")
               for name, level in (("Ground floor", 0), ("Attic", 4000))}
    add(f"IFCRELAGGREGATES({root('')},{project},({building}))")
    add(f"IFCRELAGGREGATES({root('')},{building},({','.join(storeys.values())}))")
    elements = {name: [] for name in storeys}
    for name, _, polygons in SURFACES:
        faces = []
        for polygon in polygons:
            points = [add(f"IFCCARTESIANPOINT(({','.join(f'{1000 * v:g}.' for v in p)}))") for p in polygon]
            loop = add(f"IFCPOLYLOOP(({','.join(points)}))")
            bound = add(f"IFCFACEOUTERBOUND({loop},.T.)")
            faces.append(add(f"IFCFACE(({bound}))"))
        shell = add(f"IFCOPENSHELL(({','.join(faces)}))")
        model = add(f"IFCSHELLBASEDSURFACEMODEL(({shell}))")
        representation = add(f"IFCSHAPEREPRESENTATION({context},'Body','SurfaceModel',({model}))")
        shape = add(f"IFCPRODUCTDEFINITIONSHAPE($,$,({representation}))")
        kind = {"Roof": "IFCROOF", "Floor": "IFCSLAB"}.get(name, "IFCWALL")
        # Two walls have one name, so that their storeys tell them apart.
        called = "Gable" if name in ("Left", "Right") else name
        rest = {"IFCROOF": ",.GABLE_ROOF.", "IFCSLAB": ",.FLOOR."}.get(kind, "")
        storey = "Attic" if name in ("Roof", "Right") else "Ground floor"
        elements[storey].append(add(f"{kind}({root(called)},$,{place},{shape},${rest})"))
    for name, members in elements.items():
        add(f"IFCRELCONTAINEDINSPATIALSTRUCTURE({root('')},$,({','.join(members)}),{storeys[name]})".replace("'',$,$", "$,$"))
    body = "\n".join(entities)
    return ("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');\n"
            "FILE_NAME('house.ifc','2026-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n"
            f"{body}\nENDSEC;\nEND-ISO-10303-21;\n")


def city_json():
    """Each surface as an object, in half meters by its transform; the material as its type."""
    points, _ = indexed([polygon for _, _, polygons in SURFACES for polygon in polygons])
    objects = {}
    for name, material, polygons in SURFACES:
        boundaries = [[[points.index(p) for p in polygon]] for polygon in polygons]
        objects[name] = {"type": material, "geometry": [{"type": "MultiSurface", "lod": "2.2", "boundaries": boundaries}]}
    model = {"type": "CityJSON", "version": "2.0", "transform": {"scale": [0.5] * 3, "translate": [0.0, 0.0, 0.0]},
             "CityObjects": objects, "vertices": [[int(2 * v) for v in p] for p in points]}
    return json.dumps(model, separators=(",", ":")).replace('},"', '},\n"') + "\n"


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for ending, text in (("dae", collada()), ("fbx", fbx()), ("dxf", dxf()), ("ifc", ifc()), ("city.json", city_json())):
        (folder / f"house.{ending}").write_text(text)
    (folder / "house.3ds").write_bytes(three_ds())


if __name__ == "__main__":
    main()
