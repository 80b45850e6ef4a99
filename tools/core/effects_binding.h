// Adds the library of effects to the Python module.
#pragma once

#include <nanobind/nanobind.h>

void addEffects(nanobind::module_& module);
