# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts that draw the documents' pictures share: views, colors, and files that are small."""

import pathlib

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
from vtkmodules.vtkImagingCore import vtkImageMapToColors
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPartitionedDataSetCollectionReader

SIZE = [860, 480]
EDGES = [0.35, 0.38, 0.42]


def new_view(position, focus, angle=30.0):
    """An empty white view from a place."""
    view = simple.CreateView("RenderView", ViewSize=SIZE, Background=[1.0, 1.0, 1.0], UseColorPaletteForBackground=0,
                             OrientationAxesVisibility=0, CameraViewAngle=angle)
    simple.Render(view)  # the first one moves the camera
    look(view, position, focus)
    return view


def look(view, position, focus):
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = list(position), list(focus), [0.0, 0.0, 1.0]


def show(source, view, color=None, edges=False, opacity=1.0):
    """In one color, or as it comes."""
    shown = simple.Show(source, view)
    if color is not None:
        shown.ColorArrayName = [None, ""]
        shown.AmbientColor = shown.DiffuseColor = color
    if edges:
        shown.SetRepresentationType("Surface With Edges")
        shown.EdgeColor = EDGES
    shown.Opacity = opacity
    shown.Ambient, shown.Diffuse = 0.4, 0.6
    return shown


def color_by(shown, view, association, array, title, limits=None, preset=None, component="Magnitude"):
    """By an array, with a legend at the right."""
    simple.ColorBy(shown, (association, array))
    table = simple.GetColorTransferFunction(array)
    if preset:
        table.ApplyPreset(preset, True)
    table.VectorMode = component
    if limits:
        table.RescaleTransferFunction(*limits)
    legend(table, view, title)
    shown.SetScalarBarVisibility(view, True)


def legend(table, view, title):
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.WindowLocation = "Any Location"
    bar.Position, bar.ScalarBarLength = [0.88, 0.25], 0.5
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.AddRangeLabels, bar.AutomaticLabelFormat, bar.LabelFormat = 0, 0, "%.3g"
    bar.TitleFontSize = bar.LabelFontSize = 14


def patches_in(file):
    """Name and source of every patch in a file."""
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(file))
    reader.Update()
    patches = reader.GetOutputDataObject(0)
    for index in range(patches.GetNumberOfPartitionedDataSets()):
        source = simple.TrivialProducer()
        source.GetClientSideObject().SetOutput(patches.GetPartitionAsDataObject(index, 0))
        yield patches.GetMetaData(index).Get(vtkCompositeDataSet.NAME()), source


def behind(source, origin, normal):
    """Whole elements on the side of a plane that its normal points away from."""
    clip = simple.Clip(Input=source, ClipType="Plane", Crinkleclip=1, Invert=1)
    clip.ClipType.Origin, clip.ClipType.Normal = list(origin), list(normal)
    return clip


def save(view, file):
    simple.Render(view)
    simple.SaveScreenshot(str(file), view, ImageResolution=SIZE)
    shrink(file)


def shrink(file):
    """Few colors are enough, and make a much smaller file."""
    file = pathlib.Path(file)
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    indices = vtkImageQuantizeRGBToIndex()
    indices.SetInputConnection(reader.GetOutputPort())
    indices.SetNumberOfColors(64)
    indices.Update()
    colors = vtkImageMapToColors()
    colors.SetInputConnection(indices.GetOutputPort())
    colors.SetLookupTable(indices.GetLookupTable())
    colors.SetOutputFormatToRGB()
    colors.Update()
    writer = vtkPNGWriter()
    writer.SetInputConnection(colors.GetOutputPort())
    writer.SetFileName(str(file))
    writer.SetCompressionLevel(9)
    writer.Write()
    print(f"{file}: {file.stat().st_size} bytes")
