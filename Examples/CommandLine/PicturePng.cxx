// SPDX-License-Identifier: GPL-3.0-or-later
/// Draws pictures into memory: shapes by the share of each pixel they cover, text by VTK's FreeType, so that neither
/// OpenGL nor a display is asked for.
#include "Commands.h"
#include "Picture.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

namespace atria::tool {

namespace {

class Canvas
{
public:
  Canvas(int w, int h) : width(w), height(h)
  {
    image->SetDimensions(width, height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), std::size_t{3} * width * height, 255);
  }

  void draw(const Bar& bar)
  {
    const double right = bar.x + bar.width;
    const double bottom = bar.y + bar.height;
    const auto overlap = [](int pixel, double low, double high) {
      return std::max(0.0, std::min(pixel + 1.0, high) - std::max<double>(pixel, low));
    };
    forPixels(bar.x, bar.y, right, bottom,
              [&](int x, int y) { blend(x, y, bar.color, overlap(x, bar.x, right) * overlap(y, bar.y, bottom)); });
  }

  void draw(const Line& line)
  {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    {
      drawSegment(line.points[i], line.points[i + 1], line.width, line.color);
    }
  }

  void draw(const Text& text)
  {
    constexpr int dpi = 72; // a point is a pixel
    vtkNew<vtkTextProperty> property;
    property->SetFontFamilyToArial();
    property->SetFontSize(static_cast<int>(std::lround(text.size)));
    property->SetBold(text.bold);
    property->SetColor(text.color[0] / 255.0, text.color[1] / 255.0, text.color[2] / 255.0);
    vtkNew<vtkImageData> drawn;
    int size[2] = {0, 0};
    vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
    if (!renderer ||
        !renderer->RenderString(property, vtkStdString(text.text), drawn, size, dpi, vtkTextRenderer::FreeType))
    {
      throw Failure(Failed, "VTK's FreeType could not draw the text '" + text.text + "'; write HTML instead of PNG");
    }
    const double shares[] = {0.0, 0.5, 1.0};
    const int left = static_cast<int>(std::lround(text.x - shares[static_cast<int>(text.anchor)] * size[0]));
    const int top = static_cast<int>(std::lround(text.y - 0.5 * size[1]));
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const auto* pixel = static_cast<const unsigned char*>(
            drawn->GetScalarPointer(drawn->GetExtent()[0] + x, drawn->GetExtent()[2] + size[1] - 1 - y, 0));
        blend(left + x, top + y, text.color, pixel[3] / 255.0);
      }
    }
  }

  vtkImageData* result() { return image; }

private:
  template <typename F> void forPixels(double left, double top, double right, double bottom, F&& use)
  {
    const int lastX = std::min(width - 1, static_cast<int>(std::floor(right)));
    const int lastY = std::min(height - 1, static_cast<int>(std::floor(bottom)));
    for (int y = std::max(0, static_cast<int>(std::floor(top))); y <= lastY; ++y)
    {
      for (int x = std::max(0, static_cast<int>(std::floor(left))); x <= lastX; ++x)
      {
        use(x, y);
      }
    }
  }

  void drawSegment(std::pair<double, double> a, std::pair<double, double> b, double thickness, const Color& color)
  {
    const double reach = 0.5 * thickness + 1.0;
    const double dx = b.first - a.first;
    const double dy = b.second - a.second;
    const double square = std::max(dx * dx + dy * dy, 1e-12);
    forPixels(std::min(a.first, b.first) - reach, std::min(a.second, b.second) - reach,
              std::max(a.first, b.first) + reach, std::max(a.second, b.second) + reach, [&](int x, int y) {
                const double px = x + 0.5 - a.first;
                const double py = y + 0.5 - a.second;
                const double along = std::clamp((px * dx + py * dy) / square, 0.0, 1.0);
                const double distance = std::hypot(px - along * dx, py - along * dy);
                blend(x, y, color, std::clamp(0.5 * thickness + 0.5 - distance, 0.0, std::min(1.0, thickness)));
              });
  }

  void blend(int x, int y, const Color& color, double share)
  {
    if (x < 0 || y < 0 || x >= width || y >= height || share <= 0.0)
    {
      return;
    }
    auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, height - 1 - y, 0));
    for (int c = 0; c < 3; ++c)
    {
      pixel[c] = static_cast<unsigned char>(std::lround(pixel[c] + share * (color[c] - pixel[c])));
    }
  }

  int width;
  int height;
  vtkNew<vtkImageData> image;
};

} // namespace

void writePng(const Picture& picture, const std::string& file)
{
  Canvas canvas(static_cast<int>(std::ceil(picture.width)), static_cast<int>(std::ceil(picture.height)));
  for (const auto& shape : picture.shapes)
  {
    std::visit([&](const auto& kind) { canvas.draw(kind); }, shape);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(canvas.result());
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw Failure(Failed, file + " could not be written; check permissions and space");
  }
}

} // namespace atria::tool
