// SPDX-License-Identifier: GPL-3.0-or-later
/// coin_scene FILE: prints what Coin reads, for readWithCoin of CoinScene.h. A program of its own, as Coin crashes on
/// some files.
#include "CoinScene.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace atria::testing {

namespace {

using Point = std::array<double, 3>;

class Collector
{
public:
  explicit Collector(CoinScene& target) : scene(target)
  {
    constexpr double inf = std::numeric_limits<double>::infinity();
    scene.bounds = {inf, -inf, inf, -inf, inf, -inf};
  }

  void begin(SoCallbackAction* action, const SoNode* node)
  {
    current = {nameOf(action), node->getTypeId().getName().getString(), 0, 0.0};
    text = current.type.find("Text") != std::string::npos;
  }

  void end()
  {
    if (current.triangles > 0)
    {
      scene.shapes.push_back(current);
    }
    current = {};
  }

  void triangle(const std::array<Point, 3>& p)
  {
    Point u;
    Point v;
    for (int i = 0; i < 3; ++i)
    {
      u[i] = p[1][i] - p[0][i];
      v[i] = p[2][i] - p[0][i];
    }
    const double area =
        0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    if (text || !(area > 0.0))
    {
      return;
    }
    ++current.triangles;
    current.area += area;
    for (const Point& corner : p)
    {
      for (int i = 0; i < 3; ++i)
      {
        scene.bounds[2 * i] = std::min(scene.bounds[2 * i], corner[i]);
        scene.bounds[2 * i + 1] = std::max(scene.bounds[2 * i + 1], corner[i]);
      }
    }
  }

private:
  static std::string nameOf(SoCallbackAction* action)
  {
    const auto* path = static_cast<const SoFullPath*>(action->getCurPath());
    const int length = path->getLength();
    const auto name = [&](int fromTail) {
      return fromTail < length ? std::string(path->getNodeFromTail(fromTail)->getName().getString()) : std::string();
    };
    const bool inShape = length > 1 && path->getNodeFromTail(1)->getTypeId().getName() == SbName("VRMLShape");
    if (inShape && !name(1).empty())
    {
      return name(1);
    }
    for (int i = 0; i < length; ++i)
    {
      if (!name(i).empty())
      {
        return name(i);
      }
    }
    return {};
  }

  CoinScene& scene;
  CoinShape current;
  bool text = false;
};

SoCallbackAction::Response before(void* data, SoCallbackAction* action, const SoNode* node)
{
  static_cast<Collector*>(data)->begin(action, node);
  return SoCallbackAction::CONTINUE;
}

SoCallbackAction::Response after(void* data, SoCallbackAction*, const SoNode*)
{
  static_cast<Collector*>(data)->end();
  return SoCallbackAction::CONTINUE;
}

void onTriangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
                const SoPrimitiveVertex* c)
{
  std::array<Point, 3> corners;
  const std::array<const SoPrimitiveVertex*, 3> vertices{a, b, c};
  for (int i = 0; i < 3; ++i)
  {
    SbVec3f p;
    action->getModelMatrix().multVecMatrix(vertices[i]->getPoint(), p);
    corners[i] = {p[0], p[1], p[2]};
  }
  static_cast<Collector*>(data)->triangle(corners);
}

void keepError(const SoError* error, void* list)
{
  static_cast<std::vector<std::string>*>(list)->emplace_back(error->getDebugString().getString());
}

CoinScene readScene(const std::filesystem::path& file)
{
  SoDB::init();
  CoinScene scene;
  SoReadError::setHandlerCallback(keepError, &scene.errors);
  SoDebugError::setHandlerCallback(keepError, &scene.errors);
  SoInput input;
  SoInput::addDirectoryFirst(file.parent_path().c_str());
  SoSeparator* root = input.openFile(file.c_str()) ? SoDB::readAll(&input) : nullptr;
  if (root)
  {
    scene.read = true;
    root->ref();
    Collector collector(scene);
    SoCallbackAction action;
    action.addPreCallback(SoShape::getClassTypeId(), before, &collector);
    action.addPostCallback(SoShape::getClassTypeId(), after, &collector);
    action.addTriangleCallback(SoShape::getClassTypeId(), onTriangle, &collector);
    action.apply(root);
    root->unref();
  }
  SoInput::removeDirectory(file.parent_path().c_str());
  SoReadError::setHandlerCallback(SoReadError::getHandlerCallback(), nullptr);
  return scene;
}

void print(const CoinScene& scene)
{
  std::printf("read %d\n", scene.read ? 1 : 0);
  for (const CoinShape& shape : scene.shapes)
  {
    std::printf("shape %zu %.17g %s %s\n", shape.triangles, shape.area, shape.type.c_str(), shape.name.c_str());
  }
  for (std::size_t i = 0; i < scene.bounds.size() && !scene.shapes.empty(); ++i)
  {
    std::printf("bound %.17g\n", scene.bounds[i]);
  }
  for (std::string error : scene.errors)
  {
    std::replace(error.begin(), error.end(), '\n', ' ');
    std::printf("error %s\n", error.c_str());
  }
  std::printf("end\n");
  std::fflush(stdout); // Coin leaks, and sanitizers end such programs without
}

} // namespace

} // namespace atria::testing

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: coin_scene FILE\n");
    return 1;
  }
  atria::testing::print(atria::testing::readScene(argv[1]));
  return 0;
}
