// The firmware's own version, shown in the greeting; B05 answers what the clients expect.
#pragma once

#define PLUMB_VERSION "0.1"
