// SPDX-License-Identifier: GPL-3.0-or-later
#include "Instances.h"

#include "Input.h"

namespace atria::vrml {

namespace {

/// Prototypes of several files can contain each other.
constexpr int deepestContext = 50;
constexpr int longestChainOfFiles = 16;

const Value none;

const Prototype* findIn(const Document& document, std::string_view name)
{
  for (const Prototype& prototype : document.prototypes)
  {
    if (name.empty() || prototype.name == name)
    {
      return &prototype;
    }
  }
  return nullptr;
}

} // namespace

/// Follows EXTERNPROTO into other files.
const Prototype* Instances::resolve(const Prototype& prototype, const Node& instance)
{
  const Prototype* found = &prototype;
  for (int i = 0; found && found->external; ++i)
  {
    const Document* document =
        i < longestChainOfFiles ? library.openBeside(*found->document, found->urls, instance) : nullptr;
    if (!document)
    {
      return nullptr;
    }
    std::string_view name;
    for (const std::string_view url : found->urls)
    {
      const std::size_t hash = url.rfind('#');
      name = hash == std::string_view::npos ? name : url.substr(hash + 1);
    }
    found = findIn(*document, name);
  }
  return found;
}

NodeRef Instances::enter(const NodeRef& instance)
{
  const int depth = instance.context ? instance.context->depth + 1 : 0;
  if (depth > deepestContext)
  {
    diagnostics.warn(placeOf(*instance.node) + ": prototypes contain each other; skipped");
    return {};
  }
  const Prototype* prototype = resolve(*instance.node->prototype, *instance.node);
  if (!prototype || !prototype->body)
  {
    return {};
  }
  const auto* body = std::get_if<Nodes>(&prototype->body->fields[0].value);
  if (!body || body->empty() || !body->front())
  {
    return {};
  }
  contexts.push_back({instance.node, prototype, instance.context, depth});
  return {body->front(), &contexts.back()};
}

NodeRef Instances::expand(NodeRef ref, std::string_view* name)
{
  while (ref)
  {
    if (name && name->empty())
    {
      *name = ref.node->name;
    }
    if (!ref.node->prototype)
    {
      break;
    }
    ref = ref.node->damaged ? NodeRef{} : enter(ref);
  }
  return ref;
}

std::pair<const Value*, const Context*> Instances::find(NodeRef ref, std::string_view name) const
{
  const Field* field = ref.node->find(name);
  const auto referenceOf = [](const Field* f) { return f ? std::get_if<Reference>(&f->value) : nullptr; };
  while (const Reference* reference = referenceOf(field))
  {
    const Context* context = ref.context;
    if (!context)
    {
      return {&none, nullptr};
    }
    const std::string_view wanted = reference->field;
    ref = {context->instance, context->outer};
    field = ref.node->find(wanted);
    if (!field)
    {
      const Field* given = context->prototype->defaults->find(wanted);
      return {given ? &given->value : &none, nullptr};
    }
  }
  return {field ? &field->value : &none, ref.context};
}

bool Instances::flag(const NodeRef& ref, std::string_view field, bool otherwise) const
{
  const bool* value = get<bool>(ref, field);
  return value ? *value : otherwise;
}

int Instances::integer(const NodeRef& ref, std::string_view field, int otherwise) const
{
  const auto* value = get<Integers>(ref, field);
  return value && !value->empty() ? value->front() : otherwise;
}

double Instances::number(const NodeRef& ref, std::string_view field, double otherwise) const
{
  const auto* value = get<Numbers>(ref, field);
  return value && !value->empty() ? value->front() : otherwise;
}

std::vector<double> Instances::numbers(const NodeRef& ref, std::string_view field, std::vector<double> otherwise) const
{
  const auto* value = get<Numbers>(ref, field);
  return value ? std::vector<double>(value->begin(), value->end()) : otherwise;
}

Vec3 Instances::vector(const NodeRef& ref, std::string_view field, const Vec3& otherwise) const
{
  const auto* value = get<Numbers>(ref, field);
  return value && value->size() >= 3 ? Vec3((*value)[0], (*value)[1], (*value)[2]) : otherwise;
}

NodeRefs Instances::nodes(const NodeRef& ref, std::string_view field) const
{
  const auto [value, context] = find(ref, field);
  const auto* list = std::get_if<Nodes>(value);
  return {list ? std::span<Node* const>(list->begin(), list->end()) : std::span<Node* const>{}, context};
}

NodeRef Instances::node(const NodeRef& ref, std::string_view field) const
{
  const auto [value, context] = find(ref, field);
  const auto* list = std::get_if<Nodes>(value);
  return list && !list->empty() ? NodeRef{list->front(), context} : NodeRef{};
}

} // namespace atria::vrml
