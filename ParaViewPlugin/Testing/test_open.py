# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin opens VRML and weather, and leaves all other formats to ParaView's readers; its reader of models is a source."""

import base64
import json
import os
import pathlib
import runpy
import shutil
import struct

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, vtkPolyData,
)
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter

from house_pipeline import load_plugin

MODEL = pathlib.Path(os.environ["ATRIA_MODEL"])
FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "open"
CORNERS = [(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)]
TRIANGLES = [(0, 1, 2), (0, 2, 3)]
# What files of each ending call their surfaces; of PLY the file is the surface.
NAMES = {
    "vtp": {"Wall", "Roof"}, "vtm": {"Wall", "Roof"}, "vtpc": {"Wall", "Roof"}, "stl": {"Wall", "Roof"},
    "obj": {"Wall", "Roof"}, "ply": {"model"}, "gltf": {"Wall", "Roof"}, "glb": {"Wall", "Roof"},
}
# Others that are read are in Testing/Data/Models.
EXCHANGED = {"json", "jsonl", "dae", "3ds", "fbx", "dxf", "ifc"}


def sheet(height, triangles=TRIANGLES):
    """A sheet with temperatures at its points."""
    data = vtkPolyData()
    points = vtkPoints()
    polys = vtkCellArray()
    temperature = vtkFloatArray()
    temperature.SetName("Temperature")
    for x, y, _ in CORNERS:
        points.InsertNextPoint(x, y, height)
        temperature.InsertNextValue(280.0 + height + x)
    for triangle in triangles:
        polys.InsertNextCell(3, triangle)
    data.SetPoints(points)
    data.SetPolys(polys)
    data.GetPointData().AddArray(temperature)
    return data


def write_vtp(file):
    data = sheet(0)
    names = vtkStringArray()
    names.SetName("SurfaceName")
    for name in ("Wall", "Roof"):
        names.InsertNextValue(name)
    data.GetCellData().AddArray(names)
    write_xml(vtkXMLPolyDataWriter(), data, file)


def write_xml(writer, data, file):
    writer.SetInputDataObject(data)
    writer.SetFileName(str(file))
    assert writer.Write(), file


def write_vtm(file):
    blocks = vtkMultiBlockDataSet()
    for i, name in enumerate(("Wall", "Roof")):
        blocks.SetBlock(i, sheet(i))
        blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    write_xml(vtkXMLMultiBlockDataWriter(), blocks, file)


def write_vtpc(file):
    blocks = vtkPartitionedDataSetCollection()
    for i, name in enumerate(("Wall", "Roof")):
        blocks.SetPartition(i, 0, sheet(i))
        blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    write_xml(vtkXMLPartitionedDataSetCollectionWriter(), blocks, file)


def write_stl(file):
    text = ""
    for name, triangle in zip(("Wall", "Roof"), TRIANGLES):
        corners = "".join(f"vertex {x} {y} {z}\n" for x, y, z in (CORNERS[i] for i in triangle))
        text += f"solid {name}\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid {name}\n"
    file.write_text(text)


def write_obj(file):
    text = "".join(f"v {x} {y} {z}\nvt {x / 4} {y / 3}\n" for x, y, z in CORNERS)
    for name, triangle in zip(("Wall", "Roof"), TRIANGLES):
        text += f"g {name}\nf " + " ".join(f"{i + 1}/{i + 1}" for i in triangle) + "\n"
    file.write_text(text)


def write_ply(file):
    text = "ply\nformat ascii 1.0\nelement vertex 4\n"
    text += "".join(f"property float {axis}\n" for axis in "xyz")
    text += "".join(f"property uchar {color}\n" for color in ("red", "green", "blue"))
    text += "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    text += "".join(f"{x} {y} {z} 255 128 0\n" for x, y, z in CORNERS)
    file.write_text(text + "".join(f"3 {a} {b} {c}\n" for a, b, c in TRIANGLES))


def gltf():
    """Two nodes with a triangle each, and the bytes they refer to."""
    data = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)
    data += b"".join(struct.pack("<3H", *triangle) for triangle in TRIANGLES)
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": name, "mesh": i} for i, name in enumerate(("Wall", "Roof"))],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": i + 1}]} for i in range(2)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [4, 3, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
            {"bufferView": 1, "byteOffset": 6, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48, "target": 34962},
            {"buffer": 0, "byteOffset": 48, "byteLength": 12, "target": 34963},
        ],
        "buffers": [{"byteLength": 60}],
    }
    return scene, data


def write_gltf(file):
    scene, data = gltf()
    scene["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    file.write_text(json.dumps(scene))


def write_glb(file):
    scene, data = gltf()
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


WRITERS = {
    "vtp": write_vtp, "vtm": write_vtm, "vtpc": write_vtpc, "stl": write_stl, "obj": write_obj, "ply": write_ply,
    "gltf": write_gltf, "glb": write_glb,
}


def describe(source):
    """What a reader is, and what it has read: type, blocks, and arrays with their ranges."""
    source.UpdatePipeline()
    information = source.GetDataInformation()
    arrays = [
        (kind, name, array.GetNumberOfComponents(), array.GetRange(0))
        for kind, data in (("point", source.PointData), ("cell", source.CellData))
        for name, array in data.items()
    ]
    blocks = []
    if information.IsCompositeDataSet():
        hierarchy = information.GetHierarchy()
        blocks = [hierarchy.GetNodeName(i) for i in hierarchy.GetChildNodes(hierarchy.GetRootNode())]
    return {
        "reader": source.GetXMLName(),
        "type": information.GetDataSetTypeAsString(),
        "blocks": blocks,
        "cells": information.GetNumberOfCells(),
        "arrays": arrays,
    }


def opened(file):
    source = simple.OpenDataFile(str(file))
    assert source is not None, f"ParaView cannot open {file}"
    found = describe(source)
    simple.Delete(source)
    return found


def check_others(before):
    """As ParaView opened them without the plugin."""
    for ending, wanted in before.items():
        found = opened(FOLDER / f"model.{ending}")
        assert found == wanted, f".{ending} is opened as {found}, without the plugin as {wanted}"
    assert [a[1] for a in before["vtp"]["arrays"]] == ["Temperature", "SurfaceName"], before["vtp"]
    for ending in ("vtm", "vtpc"):
        assert len(before[ending]["blocks"]) == 2, before[ending]


def check_vrml():
    for ending in ("wrl", "vrml", "wrz", "wrl.gz"):
        file = FOLDER / f"model.{ending}"
        shutil.copyfile(MODEL, file)
        found = opened(file)
        assert found["reader"] == "AtriaVRMLReader", f".{ending} is opened by {found['reader']}"
        assert found["cells"] > 50, found


def surface_names(data):
    names = data.GetFieldData().GetAbstractArray("SurfaceName")
    return {names.GetValue(i) for i in range(names.GetNumberOfValues())}


def check_model_reader():
    """By a file's name it keeps the names of surfaces."""
    for ending, names in NAMES.items():
        reader = simple.AtriaModelReader(FileName=str(FOLDER / f"model.{ending}"))
        reader.UpdatePipeline()
        found = surface_names(reader.GetClientSideObject().GetOutput())
        assert found == names, f".{ending}: surfaces {found}, expected {names}"
        simple.Delete(reader)
    city = pathlib.Path(__file__).parents[2] / "Testing" / "Data" / "Models" / "house.city.json"
    reader = simple.AtriaModelReader(FileName=str(city))
    reader.UpdatePipeline()
    assert len(surface_names(reader.GetClientSideObject().GetOutput())) > 3
    simple.Delete(reader)


def check_menu():
    """The reader of models is in the menu Sources > Atria, asks for a file in its panel, and opens none by itself."""
    reader = simple.AtriaModelReader()
    hints = reader.GetHints()
    assert hints.FindNestedElementByName("ReaderFactory") is None
    assert hints.FindNestedElementByName("ShowInMenu").GetAttribute("category") == "Atria"
    file_name = reader.GetProperty("FileName").SMProperty
    assert file_name.GetPanelVisibility() == "default"
    assert file_name.FindDomain("vtkSMFileListDomain") is not None
    chooser = file_name.GetHints().FindNestedElementByName("FileChooser")
    assert set(chooser.GetAttribute("extensions").split()) == set(NAMES) | EXCHANGED, chooser.GetAttribute("extensions")


def write_weather():
    """A year as EPW; a file that begins as TMY3 does; a table that is no weather."""
    make_weather = pathlib.Path(__file__).parents[2] / "Examples" / "NaturalVentilation" / "make_weather.py"
    runpy.run_path(str(make_weather))["main"](FOLDER / "year.epw")
    (FOLDER / "tmy3.csv").write_text('700000,"CITY",ST,1.0,50,8,10\nDate (MM/DD/YYYY),Time (HH:MM)\n')
    (FOLDER / "table.csv").write_text("from,frequency,scale,shape\n0,1,4,2\n")


def check_weather():
    """A year opens as the table of its wind. Tables that are no weather are ParaView's."""
    write_weather()
    reader = simple.OpenDataFile(str(FOLDER / "year.epw"))
    assert reader.GetXMLName() == "AtriaWeatherReader", reader.GetXMLName()
    reader.Sectors = 4
    reader.UseTemperatureRange = 1
    reader.UpdatePipeline()
    table = reader.GetClientSideObject().GetOutput()
    assert [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())] == ["from", "frequency", "scale", "shape"]
    assert table.GetNumberOfRows() == 4
    assert 0 < table.GetFieldData().GetArray("HoursKept").GetValue(0) < 8760
    simple.Delete(reader)
    table = simple.OpenDataFile(str(FOLDER / "table.csv"))
    assert table.GetXMLName() == "CSVReader", table.GetXMLName()
    simple.Delete(table)
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    session = servermanager.ActiveConnection.Session
    for file, wanted in (("tmy3.csv", True), ("table.csv", False)):
        readers = factory.GetReaders(str(FOLDER / file), session)
        names = {readers.GetString(i) for i in range(readers.GetNumberOfStrings())}
        assert ("AtriaWeatherReader" in names, "CSVReader" in names) == (wanted, True), (file, names)


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    for ending, write in WRITERS.items():
        write(FOLDER / f"model.{ending}")
    before = {ending: opened(FOLDER / f"model.{ending}") for ending in WRITERS}
    load_plugin()
    check_others(before)
    check_vrml()
    check_weather()
    check_model_reader()
    check_menu()
    for ending, found in before.items():
        print(f".{ending}: {found['reader']}")


main()
