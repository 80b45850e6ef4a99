// Whether the stack has ever grown into the bytes above the program's data.
#pragma once

namespace board {
namespace stack_guard {

/// Paints the last bytes that the stack may take. To be called once, from setup().
void paint();

/// Whether these bytes are as they were painted. If not, the stack has perhaps run into the data.
bool isWhole();

}  // namespace stack_guard
}  // namespace board
