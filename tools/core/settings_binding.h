// The firmware's settings seen from Python, as part of the same module.
#pragma once

#include <nanobind/nanobind.h>

/// Adds the functions about settings to the module.
void addSettings(nanobind::module_& module);
