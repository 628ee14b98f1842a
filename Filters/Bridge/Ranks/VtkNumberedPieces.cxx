// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/VtkNumberedPieces.h"

#include "Support/Error.h"
#include "VtkSubset.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace atria {

namespace {

constexpr const char* cellIdsName = "GlobalCellIds";
constexpr const char* pointIdsName = "GlobalPointIds";

vtkDataArray* globalIds(vtkDataSetAttributes* data, const char* name)
{
  vtkDataArray* ids = data->GetGlobalIds();
  return ids ? ids : data->GetArray(name);
}

/// A cell or point of a piece.
struct Numbered
{
  vtkIdType id;
  Index piece;
  vtkIdType at;

  auto operator<=>(const Numbered&) const = default;
};
using Order = std::vector<Numbered>;

void append(vtkDataArray* ids, Index piece, vtkIdType at, Order& order)
{
  auto* exact = vtkIdTypeArray::SafeDownCast(ids);
  order.push_back({exact ? exact->GetValue(at) : static_cast<vtkIdType>(ids->GetComponent(at, 0)), piece, at});
}

bool hasNoGaps(const Order& order)
{
  return order.empty() || order.back().id - order.front().id + 1 == static_cast<vtkIdType>(order.size());
}

/// Joins the arrays that all pieces have, in the order of the whole.
template <typename Attributes>
void joinTuples(const std::vector<Attributes*>& pieces, const Order& order, const char* idsName,
                vtkDataSetAttributes* whole)
{
  std::vector<vtkNew<vtkIdList>> from(pieces.size()), to(pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    from[order[i].piece]->InsertNextId(order[i].at);
    to[order[i].piece]->InsertNextId(static_cast<vtkIdType>(i));
  }
  vtkDataSetAttributes* first = pieces.front();
  for (int i = 0; i < first->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = first->GetAbstractArray(i);
    const char* name = array->GetName();
    const auto hasIt = [&](Attributes* piece) {
      vtkAbstractArray* own = name ? piece->GetAbstractArray(name) : nullptr;
      return own && own->GetDataType() == array->GetDataType() &&
             own->GetNumberOfComponents() == array->GetNumberOfComponents();
    };
    if (!std::ranges::all_of(pieces, hasIt) || std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0 ||
        (std::strcmp(name, idsName) == 0 && hasNoGaps(order)))
    {
      continue;
    }
    const auto joined = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    joined->SetName(name);
    joined->SetNumberOfComponents(array->GetNumberOfComponents());
    joined->CopyComponentNames(array);
    joined->SetNumberOfTuples(static_cast<vtkIdType>(order.size()));
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    {
      joined->InsertTuples(to[piece], from[piece], pieces[piece]->GetAbstractArray(name));
    }
    whole->AddArray(joined);
  }
  for (int attribute = 0; attribute < vtkDataSetAttributes::NUM_ATTRIBUTES; ++attribute)
  {
    vtkAbstractArray* active = first->GetAbstractAttribute(attribute);
    if (active && active->GetName() && whole->HasArray(active->GetName()))
    {
      whole->SetActiveAttribute(active->GetName(), attribute);
    }
  }
}

/// Used points of the pieces, each once.
class JoinedPoints
{
public:
  template <typename Piece> explicit JoinedPoints(const std::vector<Piece*>& pieces)
  {
    for (Piece* piece : pieces)
    {
      newPoint.emplace_back(static_cast<std::size_t>(piece->GetNumberOfPoints()), -1);
    }
  }

  void use(Index piece, vtkIdType point) { newPoint[piece][static_cast<std::size_t>(point)] = 0; }

  template <typename Piece> void number(const std::vector<Piece*>& pieces)
  {
    Order all;
    for (Index piece = 0; piece < pieces.size(); ++piece)
    {
      vtkDataArray* ids = globalIds(pieces[piece]->GetPointData(), pointIdsName);
      for (std::size_t p = 0; p < newPoint[piece].size(); ++p)
      {
        if (newPoint[piece][p] == 0)
        {
          append(ids, piece, static_cast<vtkIdType>(p), all);
        }
      }
    }
    std::ranges::sort(all);
    for (const Numbered& point : all)
    {
      if (order.empty() || order.back().id != point.id)
      {
        order.push_back(point);
      }
      newPoint[point.piece][static_cast<std::size_t>(point.at)] = static_cast<vtkIdType>(order.size()) - 1;
    }
  }

  template <typename Piece> void fill(const std::vector<Piece*>& pieces, vtkPointSet* whole) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(pieces.front()->GetPoints() ? pieces.front()->GetPoints()->GetDataType() : VTK_DOUBLE);
    points->SetNumberOfPoints(static_cast<vtkIdType>(order.size()));
    std::vector<vtkPointData*> data;
    std::ranges::transform(pieces, std::back_inserter(data), [](Piece* piece) { return piece->GetPointData(); });
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      points->GetData()->SetTuple(static_cast<vtkIdType>(i), order[i].at,
                                  pieces[order[i].piece]->GetPoints()->GetData());
    }
    whole->SetPoints(points);
    joinTuples(data, order, pointIdsName, whole->GetPointData());
  }

  Order order;
  std::vector<VtkIds> newPoint; ///< one list per piece
};

template <typename Piece> Order orderOfCells(const std::vector<Piece*>& pieces)
{
  Order order;
  for (Index piece = 0; piece < pieces.size(); ++piece)
  {
    vtkDataArray* ids = globalIds(pieces[piece]->GetCellData(), cellIdsName);
    vtkUnsignedCharArray* ghosts = pieces[piece]->GetCellGhostArray();
    constexpr int leftOut = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
    for (vtkIdType cell = 0; cell < pieces[piece]->GetNumberOfCells(); ++cell)
    {
      if (!ghosts || (ghosts->GetValue(cell) & leftOut) == 0)
      {
        append(ids, piece, cell, order);
      }
    }
  }
  std::ranges::sort(order);
  const auto twice = std::ranges::adjacent_find(order, {}, &Numbered::id);
  if (twice != order.end())
  {
    throw Error("two pieces of the mesh have the cell of global id " + std::to_string(twice->id) +
                ", and neither has it as a ghost");
  }
  return order;
}

template <typename Piece>
void joinCellData(const std::vector<Piece*>& pieces, const Order& order, vtkDataSetAttributes* whole)
{
  std::vector<vtkCellData*> data;
  std::ranges::transform(pieces, std::back_inserter(data), [](Piece* piece) { return piece->GetCellData(); });
  joinTuples(data, order, cellIdsName, whole);
}

template <typename Piece> JoinedPoints joinedPoints(const std::vector<Piece*>& pieces, const Order& order)
{
  JoinedPoints points(pieces);
  vtkNew<vtkIdList> corners;
  for (const Numbered& cell : order)
  {
    pieces[cell.piece]->GetCellPoints(cell.at, corners);
    std::for_each(corners->begin(), corners->end(), [&](vtkIdType p) { points.use(cell.piece, p); });
  }
  points.number(pieces);
  return points;
}

} // namespace

bool isNumbered(vtkDataSet* piece)
{
  return globalIds(piece->GetCellData(), cellIdsName) && globalIds(piece->GetPointData(), pointIdsName);
}

bool isInPieces(vtkUnstructuredGrid* grid)
{
  if (grid->HasAnyGhostCells())
  {
    return true;
  }
  Order points;
  vtkDataArray* ids = globalIds(grid->GetPointData(), pointIdsName);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    append(ids, 0, p, points);
  }
  std::ranges::sort(points);
  return std::ranges::adjacent_find(points, {}, &Numbered::id) != points.end();
}

NumberedWhole joinNumberedGrids(const std::vector<vtkUnstructuredGrid*>& pieces)
{
  NumberedWhole out{vtkSmartPointer<vtkUnstructuredGrid>::New(), {}};
  const Order order = orderOfCells(pieces);
  const JoinedPoints points = joinedPoints(pieces, order);
  points.fill(pieces, out.grid);
  GridBuilder builder;
  for (const Numbered& cell : order)
  {
    builder.add(pieces[cell.piece], cell.at, points.newPoint[cell.piece]);
    out.pieceOf.push_back(cell.piece);
  }
  builder.finish(out.grid,
                 std::ranges::all_of(pieces, [](vtkUnstructuredGrid* piece) { return isNarrow(piece->GetCells()); }));
  joinCellData(pieces, order, out.grid->GetCellData());
  out.grid->GetFieldData()->PassData(pieces.front()->GetFieldData());
  return out;
}

vtkSmartPointer<vtkPolyData> joinNumberedSurfaces(const std::vector<vtkPolyData*>& pieces)
{
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  const Order order = orderOfCells(pieces);
  const JoinedPoints points = joinedPoints(pieces, order);
  points.fill(pieces, whole);
  VtkIds offsets{0}, connectivity;
  vtkNew<vtkIdList> corners;
  for (const Numbered& cell : order)
  {
    pieces[cell.piece]->GetCellPoints(cell.at, corners);
    std::transform(corners->begin(), corners->end(), std::back_inserter(connectivity),
                   [&](vtkIdType p) { return points.newPoint[cell.piece][static_cast<std::size_t>(p)]; });
    offsets.push_back(static_cast<vtkIdType>(connectivity.size()));
  }
  const bool areNarrow = std::ranges::all_of(pieces, [](vtkPolyData* piece) { return isNarrow(piece->GetPolys()); });
  whole->SetPolys(cellArray(offsets, connectivity, areNarrow));
  joinCellData(pieces, order, whole->GetCellData());
  whole->GetFieldData()->PassData(pieces.front()->GetFieldData());
  return whole;
}

} // namespace atria
