# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts and pictures that stand in a page of HTML: SVG, with PNG inside where there are fields."""

from __future__ import annotations

import base64
import html
import math

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

_COLORS = ("#2b6cb0", "#c05621", "#2f855a", "#805ad5", "#b83280", "#718096", "#b7791f", "#285e61")
_WIDTH, _HEIGHT = 640, 280
_LEFT, _RIGHT, _TOP, _BOTTOM = 64, 260, 30, 34
_MOST_POINTS = 400
_MOST_NAMES = 13
_MOST_LETTERS = 36  # of a name, as wide as _RIGHT
UNKNOWN = (235, 235, 235)


def ticks(low, high, about=5):
    """Steps of 1, 2 or 5 times a power of ten within a range."""
    rough = (high - low) / about or 1.0
    power = 10 ** math.floor(math.log10(rough))
    step = next(power * digit for digit in (1, 2, 5, 10) if power * digit >= rough * (1 - 1e-9))
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def _decades(low, high):
    step = max(1, math.ceil((high - low) / 6))
    return list(range(math.ceil(low), math.floor(high) + 1, step))


def _shortened(name):
    """Names that differ at their end, as those of openings do, still differ."""
    half = _MOST_LETTERS // 2
    return name if len(name) <= _MOST_LETTERS else f"{name[:half]}…{name[-half:]}"


def _drawable(series, logarithmic):
    """Without what the axis does not take, and thinned."""
    for name, times, values in series:
        times, values = numpy.asarray(times, float), numpy.asarray(values, float)
        fits = numpy.isfinite(values) & ((values > 0) if logarithmic else True)
        stride = max(1, int(fits.sum()) // _MOST_POINTS)
        if fits.any():
            yield name, times[fits][::stride], (numpy.log10(values[fits]) if logarithmic else values[fits])[::stride]


def line_chart(title, series, logarithmic=False, along="iteration") -> str:
    """Values over iterations, or what `along` says, as SVG. `series` are (name, times, values)."""
    drawn = list(_drawable(series, logarithmic))
    text = [
        f'<svg class="chart" viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" role="img" font-family="sans-serif" font-size="11">',
        f'<text x="{_LEFT}" y="16" font-size="13" font-weight="bold">{html.escape(title)}</text>',
    ]
    if drawn:
        text += _axes_and_lines(drawn, logarithmic, along)
    else:
        text.append(f'<text x="{_LEFT}" y="{_HEIGHT // 2}">no values</text>')
    return "\n".join([*text, "</svg>"])


def _range_of(drawn):
    low = min(values.min() for _, _, values in drawn)
    high = max(values.max() for _, _, values in drawn)
    if high - low < 1e-12 * max(1.0, abs(high)):
        return low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    return low, high


def _axes_and_lines(drawn, logarithmic, along):
    first = min(times[0] for _, times, _ in drawn)
    last = max(max(times[-1] for _, times, _ in drawn), first + 1e-9)
    low, high = _range_of(drawn)
    right, bottom = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM

    def place_x(time):
        return _LEFT + (time - first) / (last - first) * (right - _LEFT)

    def place_y(value):
        return bottom - (value - low) / (high - low) * (bottom - _TOP)

    text = []
    for tick in _decades(low, high) if logarithmic else ticks(low, high):
        label = f"1e{tick:+03d}" if logarithmic else f"{tick:.4g}"
        y = place_y(tick)
        text.append(f'<path d="M{_LEFT} {y:.1f}H{right}" stroke="#ddd"/>'
                    f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{label}</text>')
    for tick in ticks(first, last):
        x = place_x(tick)
        text.append(f'<path d="M{x:.1f} {bottom}v4" stroke="#444"/>'
                    f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{tick:.6g}</text>')
    text.append(f'<path d="M{_LEFT} {_TOP}V{bottom}H{right}" fill="none" stroke="#444"/>'
                f'<text x="{right}" y="{_HEIGHT - 4}" text-anchor="end">{along}</text>')
    for i, (name, times, values) in enumerate(drawn):
        points = " ".join(f"{place_x(t):.1f},{place_y(v):.1f}" for t, v in zip(times, values))
        text += _line(i, name, points, right)
    return text


def _line(i, name, points, right):
    color = _COLORS[i % len(_COLORS)]
    text = [f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"/>']
    y = _TOP + 8 + 16 * i
    if i < _MOST_NAMES:
        text.append(f'<path d="M{right + 8} {y}h14" stroke="{color}" stroke-width="3"/>'
                    f'<text x="{right + 26}" y="{y + 4}">{html.escape(_shortened(name))}</text>')
    elif i == _MOST_NAMES:
        text.append(f'<text x="{right + 26}" y="{y + 4}">… and others</text>')
    return text


def png(colors) -> bytes:
    """Of an array rows × columns × 3 of bytes, the first row on top."""
    colors = numpy.ascontiguousarray(numpy.asarray(colors, numpy.uint8)[::-1])
    height, width, _ = colors.shape
    picture = vtkImageData()
    picture.SetDimensions(width, height, 1)
    picture.GetPointData().SetScalars(numpy_to_vtk(colors.reshape(-1, 3), deep=1))
    writer = vtkPNGWriter()
    writer.SetInputData(picture)
    writer.WriteToMemoryOn()
    writer.Write()
    return vtk_to_numpy(writer.GetResult()).tobytes()


def embedded(data: bytes) -> str:
    """A PNG as the address of an image."""
    return "data:image/png;base64," + base64.b64encode(data).decode()


def figure(content: str, caption: str) -> str:
    return f"<figure>{content}<figcaption>{html.escape(caption)}</figcaption></figure>"


def plot(colors, lines=(), arrows=(), width=540) -> str:
    """A field as a picture of `width`, with lines of walls and arrows over it, as SVG.

    colors  rows × columns × 3 bytes
    lines   pairs of points, and arrows (point, way) with the length of the longest way a share of the picture's width;
            in shares of its width from the left, and of its height from the top
    """
    rows, columns, _ = colors.shape
    height = width * rows / columns

    def at(point):
        return f"{point[0] * width:.1f} {point[1] * height:.1f}"

    walls = "".join(f"M{at(a)}L{at(b)}" for a, b in lines)
    heads = "".join(
        f"M{at(point)}l{way[0] * width:.1f} {way[1] * width:.1f}"
        f"m{(-0.35 * way[0] - 0.2 * way[1]) * width:.1f} {(-0.35 * way[1] + 0.2 * way[0]) * width:.1f}"
        f"l{(0.35 * way[0] + 0.2 * way[1]) * width:.1f} {(0.35 * way[1] - 0.2 * way[0]) * width:.1f}"
        f"l{(-0.35 * way[0] + 0.2 * way[1]) * width:.1f} {(-0.35 * way[1] - 0.2 * way[0]) * width:.1f}"
        for point, way in arrows
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height:.0f}" width="{width}" role="img">'
        f'<image href="{embedded(png(colors))}" width="{width}" height="{height:.0f}" preserveAspectRatio="none"'
        ' style="image-rendering: pixelated"/>'
        f'<path d="{heads}" fill="none" stroke="#fff" stroke-width="0.9"/>'
        f'<path d="{walls}" fill="none" stroke="#111" stroke-width="1.6"/></svg>'
    )


def colored(values, low, high):
    """Bytes of red, green and blue: from dark blue over green to yellow (viridis); grey for what is no number."""
    stops = numpy.array([(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)], float)
    values = numpy.asarray(values, float)
    share = numpy.clip((numpy.nan_to_num(values) - low) / ((high - low) or 1.0), 0.0, 1.0) * (len(stops) - 1)
    colors = numpy.stack([numpy.interp(share, range(len(stops)), stops[:, c]) for c in range(3)], axis=-1)
    colors[numpy.isnan(values)] = UNKNOWN
    return colors.astype(numpy.uint8)


def color_bar(low, high, unit) -> str:
    """The scale of `colored`, to stand below a picture."""
    colors = colored(numpy.linspace(low, high, 9), low, high)
    stops = ", ".join("rgb({}, {}, {})".format(*color) for color in colors)
    return (f'<div class="bar"><span>{low:.3g}</span><i style="background: linear-gradient(to right, {stops})"></i>'
            f"<span>{high:.3g} {html.escape(unit)}</span></div>")
