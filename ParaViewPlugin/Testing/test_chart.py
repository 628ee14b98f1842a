# SPDX-License-Identifier: GPL-3.0-or-later
"""The histogram opens in ParaView's bar and line charts as it is."""

import os
import pathlib

from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
import numpy

from house_pipeline import house


def draw(histogram, view_type, series, file):
    view = simple.CreateView(view_type)
    view.ViewSize = [800, 500]
    display = simple.Show(histogram, view)
    assert series in list(display.SeriesLabel), f"{view_type} offers no series {series}"
    if view_type == "XYBarChartView":
        # As it opens by itself.
        assert list(display.SeriesVisibility) == [series], list(display.SeriesVisibility)
        assert (display.UseIndexForXAxis, display.XArrayName) == (0, "Value")
    else:
        display.UseIndexForXAxis = 0
        display.XArrayName = "OrthogonalQuality"
        display.SeriesVisibility = [series]
    display.SeriesColor = [series, "0", "0", "1"]
    simple.Render(view)
    file.unlink(missing_ok=True)
    simple.SaveScreenshot(str(file), view)


def blue_pixels(file):
    """Where in the picture the series is: rows and columns of blue pixels."""
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)
    return numpy.nonzero((pixels[:, :, 2] > 200) & (pixels[:, :, 0] < 80) & (pixels[:, :, 1] < 80))


def main():
    quality = house().quality
    quality.HistogramMetric = "OrthogonalQuality"
    simple.UpdatePipeline(proxy=quality)
    histogram = simple.OutputPort(quality, 2)
    for view_type, series in (("XYBarChartView", "PDF"), ("XYChartView", "OrthogonalQuality_CDF")):
        file = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / f"{view_type}.png"
        draw(histogram, view_type, series, file)
        rows, columns = blue_pixels(file)
        assert len(rows) > 200, f"{file} shows no {series}"
        # Most cells are good: what there is reaches to the right, and up there.
        right = rows[columns > numpy.percentile(columns, 95)]
        assert right.max() > 0.9 * rows.max(), f"{series} does not rise to the right in {file}"
        print(f"{file}: {len(rows)} pixels of {series}")


main()
