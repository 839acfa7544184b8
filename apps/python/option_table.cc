// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/option_table.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include <pybind11/stl.h>

#include "apps/python/bindings.h"
#include "apps/python/plain_array.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

constexpr char kWindowPrefix[] = "mapping.window.";

OdometryOptions WithWindow(const BundleAdjustmentOptions& window) {
  OdometryOptions options;
  options.mapping.window = window;
  return options;
}

// The value as text for SetOption().
std::string ToText(py::object value) {
  if (py::hasattr(value, "item")) value = value.attr("item")();  // a NumPy scalar
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::float_>(value)) return FormatNumber(value.cast<double>());
  return py::str(value);
}

// Makes an optional number or a list unset; returns false for any other option.
bool Unset(const Option& option) {
  if (const auto* number = std::get_if<std::optional<int>*>(&option.value)) {
    (*number)->reset();
    return true;
  }
  if (const auto* number = std::get_if<std::optional<double>*>(&option.value)) {
    (*number)->reset();
    return true;
  }
  if (const auto* list = std::get_if<NumberList>(&option.value)) {
    list->values->clear();
    return true;
  }
  return false;
}

struct ToPython {
  template <typename T>
  py::object operator()(const T* value) const {
    return py::cast(*value);
  }
  template <typename T>
  py::object operator()(const std::optional<T>* value) const {
    return *value ? py::cast(**value) : py::object(py::none());
  }
  py::object operator()(const NumberList& list) const { return py::cast(*list.values); }
  py::object operator()(const Choice& choice) const {
    return py::cast(choice.names.at(choice.get()));
  }
};

}  // namespace

OptionTable::OptionTable(const OdometryOptions& values, std::string prefix)
    : values_(values), prefix_(std::move(prefix)) {}

// The options of the table, with their names in Python. Pointers are into `values_`.
std::vector<Option> OptionTable::List() const {
  std::vector<Option> list;
  auto* values = const_cast<OdometryOptions*>(&values_);
  for (Option& option :
       prefix_.empty() ? ListOptions(values) : ListWindowOptions(&values->mapping.window)) {
    option.path.erase(0, prefix_.size());
    list.push_back(std::move(option));
  }
  return list;
}

std::vector<std::string> OptionTable::Names() const {
  std::vector<std::string> names;
  for (const Option& option : List()) names.push_back(option.path);
  return names;
}

bool OptionTable::Contains(const std::string& name) const {
  return FindByPath(List(), name) != nullptr;
}

py::object OptionTable::Get(const std::string& name) const {
  const std::vector<Option> options = List();
  const Option* option = FindByPath(options, name);
  if (option == nullptr) {
    throw py::key_error(UnknownOptionMessage(options, name, "list(options) names all"));
  }
  return std::visit(ToPython{}, option->value);
}

void OptionTable::Set(const std::string& name, py::handle value) {
  const std::vector<Option> options = List();
  const Option* option = FindByPath(options, name);
  if (option == nullptr) {
    throw std::invalid_argument(UnknownOptionMessage(options, name, "list(options) names all"));
  }
  if (IsMasked(value)) throw std::invalid_argument(name + " must not be masked");
  if (value.is_none() && Unset(*option)) return;
  const std::string text = ToText(py::reinterpret_borrow<py::object>(value));
  std::string expected;
  if (!SetOption(*option, text, &expected)) {
    throw std::invalid_argument(name + " must be " + expected + ", not " +
                                std::string(py::repr(value)));
  }
}

void OptionTable::SetAll(const py::kwargs& values) {
  for (const auto& [name, value] : values) Set(py::cast<std::string>(name), value);
}

std::string OptionTable::Describe(const std::string& class_name,
                                  const OptionTable& defaults) const {
  std::string names, others;
  for (const std::string& name : Names()) {
    const py::object value = Get(name);
    if (value.equal(defaults.Get(name))) continue;
    const std::string text = py::repr(value);
    std::string& list = name.find('.') == std::string::npos ? names : others;
    list += list.empty() ? "" : ", ";
    list += name.find('.') == std::string::npos ? name + "=" + text : "'" + name + "': " + text;
  }
  if (!others.empty()) others = (names.empty() ? "**{" : ", **{") + others + "}";
  return class_name + "(" + names + others + ")";
}

WindowOptionsTable::WindowOptionsTable(const BundleAdjustmentOptions& options)
    : OptionTable(WithWindow(options), kWindowPrefix) {}

namespace {

// Declares what both classes have in common.
template <typename Table>
py::class_<Table> BindTable(py::module_* module, const char* name, const char* doc) {
  py::class_<Table> table(*module, name, doc);
  table
      .def(py::init([](const py::kwargs& values) {
             Table made;
             made.SetAll(values);
             return made;
           }),
           "Options by name; the others have their defaults. Names with dots: "
           "**{\"a.b\": value}. Raises ValueError on an unknown name or an invalid value.")
      .def("__getitem__", &Table::Get)
      .def("__setitem__", &Table::Set)
      .def("__contains__", &Table::Contains)
      .def("__len__", [](const Table& self) { return self.Names().size(); })
      .def("__iter__", [](const Table& self) { return py::iter(py::cast(self.Names())); })
      .def("keys", &Table::Names, "The names of all options.")
      .def("__repr__", [name](const Table& self) { return self.Describe(name, Table()); });
  table.attr("__hash__") = py::none();
  return table;
}

}  // namespace

void BindOptions(py::module_* module) {
  BindTable<OptionsTable>(
      module, "Options",
      "The options of the odometry by name, as in docs/options.md: options[\"mode\"] = \"pl-vo\". "
      "dict(options) holds all of them.")
      .def_static(
          "read",
          [](const py::object& path) {
            Configuration configuration;
            ReadConfiguration(PathArgument(path), &configuration);
            return OptionsTable(configuration.odometry);
          },
          py::arg("path"),
          "Reads a YAML file as written by `msc_vo replay --print-config`. Its camera section is "
          "for Sequence(config=...).");
  BindTable<WindowOptionsTable>(
      module, "WindowOptions",
      "The options of local bundle adjustment by name: the options mapping.window.NAME of the "
      "odometry, here called NAME. landmark_noise.enabled is off by default, consensus.enabled "
      "on.");
}

}  // namespace msc_vo
