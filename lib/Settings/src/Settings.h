// Front door of the settings: values in RAM, their table, and everything that survives a power cut.
#pragma once

#include "format.h"
#include "memory.h"
#include "text.h"
#include "values.h"
