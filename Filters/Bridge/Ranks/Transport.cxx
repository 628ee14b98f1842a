// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/Transport.h"

#include "VtkVersions.h"

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiProcessController.h>
#include <vtkMultiProcessStream.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <vector>

namespace atria {

namespace {

constexpr int tag = 27183;

enum Kind : int
{
  nothing,
  grid,
  surface,
  collection,
  other
};

Kind kindOf(vtkDataObject* data)
{
  return !data                                                 ? nothing
         : vtkUnstructuredGrid::SafeDownCast(data)             ? grid
         : vtkPolyData::SafeDownCast(data)                     ? surface
         : vtkPartitionedDataSetCollection::SafeDownCast(data) ? collection
                                                               : other;
}

/// Returns the array, or a copy with contiguous values.
vtkSmartPointer<vtkAbstractArray> plainArray(vtkAbstractArray* array)
{
  if (!array || !vtkDataArray::SafeDownCast(array) || array->HasStandardMemoryLayout())
  {
    return array;
  }
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(array->GetDataType()));
  copy->DeepCopy(array);
  return copy;
}

/// The values of an array in memory.
struct Bytes
{
  unsigned char* first;
  vtkIdType count;
};

Bytes bytesOf(vtkAbstractArray* array)
{
  const vtkIdType values = array->GetNumberOfValues();
  const vtkIdType count = array->GetDataType() == VTK_BIT ? (values + 7) / 8 : values * array->GetDataTypeSize();
  return {count > 0 ? static_cast<unsigned char*>(array->GetVoidPointer(0)) : nullptr, count};
}

bool canBeSent(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array);
}

/// Writes the description of an array to a message; strings are part of it.
void describe(vtkAbstractArray* array, vtkMultiProcessStream& out)
{
  out << (canBeSent(array) ? 1 : 0);
  if (!canBeSent(array))
  {
    return;
  }
  out << array->GetDataType() << array->GetNumberOfComponents() << static_cast<vtkTypeInt64>(array->GetNumberOfTuples())
      << (array->GetName() ? 1 : 0) << std::string(array->GetName() ? array->GetName() : "");
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    const char* name = array->GetComponentName(i);
    out << std::string(name ? name : "");
  }
  if (auto* strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      out << std::string(strings->GetValue(i));
    }
  }
}

vtkSmartPointer<vtkAbstractArray> arrayAsDescribed(vtkMultiProcessStream& in)
{
  int is = 0;
  in >> is;
  if (!is)
  {
    return nullptr;
  }
  int type = 0, components = 1, hasName = 0;
  vtkTypeInt64 tuples = 0;
  std::string name;
  in >> type >> components >> tuples >> hasName >> name;
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->SetName(hasName ? name.c_str() : nullptr);
  for (int i = 0; i < components; ++i)
  {
    in >> name;
    if (!name.empty())
    {
      array->SetComponentName(i, name.c_str());
    }
  }
  auto* strings = vtkStringArray::SafeDownCast(array);
  for (vtkIdType i = 0; strings && i < strings->GetNumberOfValues(); ++i)
  {
    in >> name;
    strings->SetValue(i, name);
  }
  return array;
}

using Arrays = std::vector<vtkSmartPointer<vtkAbstractArray>>;

void sendArrays(vtkMultiProcessStream head, Arrays arrays, int rank, vtkMultiProcessController& controller)
{
  std::ranges::transform(arrays, arrays.begin(), [](vtkAbstractArray* array) { return plainArray(array); });
  head << static_cast<int>(arrays.size());
  for (vtkAbstractArray* array : arrays)
  {
    describe(array, head);
  }
  controller.Send(head, rank, tag);
  for (vtkAbstractArray* array : arrays)
  {
    if (!vtkDataArray::SafeDownCast(array))
    {
      continue;
    }
    if (const Bytes bytes = bytesOf(array); bytes.count > 0)
    {
      controller.Send(bytes.first, bytes.count, rank, tag);
    }
  }
}

/// Receives the arrays that `head` describes next.
Arrays receiveArrays(vtkMultiProcessStream& head, int rank, vtkMultiProcessController& controller)
{
  int count = 0;
  head >> count;
  Arrays arrays;
  for (int i = 0; i < count; ++i)
  {
    arrays.push_back(arrayAsDescribed(head));
  }
  for (vtkAbstractArray* array : arrays)
  {
    if (!vtkDataArray::SafeDownCast(array))
    {
      continue;
    }
    if (const Bytes bytes = bytesOf(array); bytes.count > 0)
    {
      controller.Receive(bytes.first, bytes.count, rank, tag);
    }
  }
  return arrays;
}

/// The three kinds of arrays with names.
std::array<vtkFieldData*, 3> namedArrays(vtkDataSet* data)
{
  return {data->GetPointData(), data->GetCellData(), data->GetFieldData()};
}

std::array<vtkCellArray*, 4> cellsOf(vtkPolyData* data)
{
  return {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()};
}

void describeAttributes(vtkFieldData* data, vtkMultiProcessStream& head)
{
  head << data->GetNumberOfArrays();
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int i = 0; attributes && i < vtkDataSetAttributes::NUM_ATTRIBUTES; ++i)
  {
    vtkAbstractArray* active = attributes->GetAbstractAttribute(i);
    head << std::string(active && active->GetName() ? active->GetName() : "");
  }
}

/// Number of arrays and names of attributes; take() adds the arrays and sets the attributes.
struct Attributes
{
  Attributes(vtkFieldData* data, vtkMultiProcessStream& head) : target(data)
  {
    head >> count;
    names.resize(vtkDataSetAttributes::SafeDownCast(data) ? vtkDataSetAttributes::NUM_ATTRIBUTES : 0);
    for (std::string& name : names)
    {
      head >> name;
    }
  }

  void take(const Arrays& arrays, std::size_t& next) const
  {
    for (int i = 0; i < count; ++i)
    {
      if (arrays[next])
      {
        target->AddArray(arrays[next]);
      }
      ++next;
    }
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (!names[i].empty())
      {
        vtkDataSetAttributes::SafeDownCast(target)->SetActiveAttribute(names[i].c_str(), static_cast<int>(i));
      }
    }
  }

  vtkFieldData* target;
  int count = 0;
  std::vector<std::string> names;
};

/// The arrays that make up points and cells, in a fixed order.
Arrays structureOf(vtkPointSet* data)
{
  Arrays arrays{data->GetPoints() ? data->GetPoints()->GetData() : nullptr};
  const auto addCells = [&](vtkCellArray* cells) {
    const bool is = cells && cells->GetNumberOfCells() > 0;
    arrays.emplace_back(is ? cells->GetOffsetsArray() : nullptr);
    arrays.emplace_back(is ? cells->GetConnectivityArray() : nullptr);
  };
  if (auto* cells = vtkUnstructuredGrid::SafeDownCast(data))
  {
    addCells(cells->GetCells());
    arrays.emplace_back(cellTypesOf(cells));
    std::ranges::copy(faceArraysOf(cells), std::back_inserter(arrays));
  }
  else
  {
    for (vtkCellArray* polygons : cellsOf(vtkPolyData::SafeDownCast(data)))
    {
      addCells(polygons);
    }
  }
  return arrays;
}

vtkSmartPointer<vtkCellArray> cellsFrom(const Arrays& arrays, std::size_t& next)
{
  vtkSmartPointer<vtkCellArray> cells;
  if (arrays[next])
  {
    cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(vtkDataArray::SafeDownCast(arrays[next]), vtkDataArray::SafeDownCast(arrays[next + 1]));
  }
  next += 2;
  return cells;
}

void takeStructure(const Arrays& arrays, std::size_t& next, vtkPointSet* data)
{
  if (auto* coordinates = vtkDataArray::SafeDownCast(arrays[next++]))
  {
    const auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetData(coordinates);
    data->SetPoints(points);
  }
  if (auto* surfaces = vtkPolyData::SafeDownCast(data))
  {
    surfaces->SetVerts(cellsFrom(arrays, next));
    surfaces->SetLines(cellsFrom(arrays, next));
    surfaces->SetPolys(cellsFrom(arrays, next));
    surfaces->SetStrips(cellsFrom(arrays, next));
    return;
  }
  const auto cells = cellsFrom(arrays, next);
  auto* types = vtkDataArray::SafeDownCast(arrays[next++]);
  std::vector<vtkDataArray*> faces;
  std::generate_n(std::back_inserter(faces), faceArrayCount,
                  [&] { return vtkDataArray::SafeDownCast(arrays[next++]); });
  if (cells)
  {
    setCells(vtkUnstructuredGrid::SafeDownCast(data), types, cells, faces);
  }
}

void sendPointSet(vtkPointSet* data, int rank, vtkMultiProcessController& controller)
{
  vtkMultiProcessStream head;
  Arrays arrays = structureOf(data);
  for (vtkFieldData* named : namedArrays(data))
  {
    describeAttributes(named, head);
    for (int i = 0; i < named->GetNumberOfArrays(); ++i)
    {
      arrays.emplace_back(named->GetAbstractArray(i));
    }
  }
  sendArrays(head, arrays, rank, controller);
}

void receivePointSet(vtkPointSet* data, int rank, vtkMultiProcessController& controller)
{
  vtkMultiProcessStream head;
  controller.Receive(head, rank, tag);
  std::vector<Attributes> attributes;
  for (vtkFieldData* named : namedArrays(data))
  {
    attributes.emplace_back(named, head);
  }
  const Arrays arrays = receiveArrays(head, rank, controller);
  std::size_t next = 0;
  takeStructure(arrays, next, data);
  for (const Attributes& named : attributes)
  {
    named.take(arrays, next);
  }
}

void sendCollection(vtkPartitionedDataSetCollection* sets, int rank, vtkMultiProcessController& controller)
{
  vtkMultiProcessStream structure;
  structure << sets->GetNumberOfPartitionedDataSets();
  for (unsigned int i = 0; i < sets->GetNumberOfPartitionedDataSets(); ++i)
  {
    const char* name = sets->HasMetaData(i) ? sets->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    structure << sets->GetNumberOfPartitions(i) << (name ? 1 : 0) << std::string(name ? name : "");
  }
  vtkFieldData* fields = sets->GetFieldData();
  Arrays arrays;
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    arrays.emplace_back(fields->GetAbstractArray(i));
  }
  sendArrays(structure, arrays, rank, controller);
  for (unsigned int i = 0; i < sets->GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < sets->GetNumberOfPartitions(i); ++j)
    {
      sendData(sets->GetPartitionAsDataObject(i, j), rank, controller);
    }
  }
}

void receiveCollection(vtkPartitionedDataSetCollection* sets, int rank, vtkMultiProcessController& controller)
{
  vtkMultiProcessStream structure;
  controller.Receive(structure, rank, tag);
  unsigned int count = 0;
  structure >> count;
  sets->SetNumberOfPartitionedDataSets(count);
  for (unsigned int i = 0; i < count; ++i)
  {
    unsigned int partitions = 0;
    int hasName = 0;
    std::string name;
    structure >> partitions >> hasName >> name;
    sets->SetNumberOfPartitions(i, partitions);
    if (hasName)
    {
      sets->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), name.c_str());
    }
  }
  for (vtkAbstractArray* array : receiveArrays(structure, rank, controller))
  {
    if (array)
    {
      sets->GetFieldData()->AddArray(array);
    }
  }
  for (unsigned int i = 0; i < count; ++i)
  {
    for (unsigned int j = 0; j < sets->GetNumberOfPartitions(i); ++j)
    {
      sets->SetPartition(i, j, receiveData(rank, controller));
    }
  }
}

} // namespace

void sendData(vtkDataObject* data, int rank, vtkMultiProcessController& controller)
{
  const int kind = kindOf(data);
  controller.Send(&kind, 1, rank, tag);
  switch (kind)
  {
    case grid:
    case surface:
      sendPointSet(vtkPointSet::SafeDownCast(data), rank, controller);
      break;
    case collection:
      sendCollection(vtkPartitionedDataSetCollection::SafeDownCast(data), rank, controller);
      break;
    case other:
      controller.Send(data, rank, tag);
      break;
    default:
      break;
  }
}

vtkSmartPointer<vtkDataObject> receiveData(int rank, vtkMultiProcessController& controller)
{
  int kind = nothing;
  controller.Receive(&kind, 1, rank, tag);
  vtkSmartPointer<vtkDataObject> data;
  switch (kind)
  {
    case grid:
      data = vtkSmartPointer<vtkUnstructuredGrid>::New();
      receivePointSet(vtkPointSet::SafeDownCast(data), rank, controller);
      break;
    case surface:
      data = vtkSmartPointer<vtkPolyData>::New();
      receivePointSet(vtkPointSet::SafeDownCast(data), rank, controller);
      break;
    case collection:
      data = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
      receiveCollection(vtkPartitionedDataSetCollection::SafeDownCast(data), rank, controller);
      break;
    case other:
      data.TakeReference(controller.ReceiveDataObject(rank, tag));
      break;
    default:
      break;
  }
  return data;
}

} // namespace atria
