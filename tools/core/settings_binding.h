// The firmware's settings, as part of the same Python module.
#pragma once

#include <nanobind/nanobind.h>

/// Adds the functions about settings to the module.
void addSettings(nanobind::module_& module);
