// Shared by the bindings of one Python module: what each adds to it, and dictionaries for Python.
#pragma once

#include <nanobind/nanobind.h>

#include <initializer_list>

/// Adds the library of effects.
void addEffects(nanobind::module_& module);
/// Adds the functions about settings.
void addSettings(nanobind::module_& module);

/// A name and its value in a dictionary.
struct Item {
  template <class Value>
  Item(const char* name, const Value& value) : name(name), value(nanobind::cast(value)) {}

  const char* name;
  nanobind::object value;
};

inline nanobind::dict dictOf(std::initializer_list<Item> items) {
  nanobind::dict dict;
  for (const Item& item : items) dict[item.name] = item.value;
  return dict;
}
