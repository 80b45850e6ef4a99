// A dry run for Python: lines in, the moves that the firmware made of them out.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "stage.h"
#include "wood.h"

namespace nb = nanobind;

namespace {

using dry_run::Stage;
using Row = std::vector<double>;

/// Numbers of a move by name, in the order of the columns.
const char* const kColumns[] = {"line",     "from_x", "from_y",    "to_x",   "to_y", "centre_x",
                                "centre_y", "sweep",  "length",    "z_from", "z_to", "asked",
                                "feed",     "top",    "by_chains", "ends"};
enum { kColumnCount = sizeof kColumns / sizeof kColumns[0] };

Row rowOf(const dry_run::Queued& move) {
  const motion::Path<float>& path = move.path;
  const bool goes = path.drawn == motion::Drawn::kYes;
  return {double(move.line), path.from.x, path.from.y,
          path.to.x,         path.to.y,   path.centre.x,
          path.centre.y,     path.sweep,  goes ? path.length : 0.0,
          move.z_from,       move.z_to,   move.asked,
          move.feed,         move.top,    double(move.by_chains),
          move.ends};
}

/// An array for Python that owns its numbers.
template <class Number>
nb::ndarray<nb::numpy, Number> owned(Number* data, std::vector<size_t> shape) {
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::ndarray<nb::numpy, Number>(data, shape.size(), shape.data(), owner);
}

nb::ndarray<nb::numpy, double> movesOf(const Stage& stage) {
  double* const data = new double[stage.moves().size() * kColumnCount];
  double* to = data;
  for (const dry_run::Queued& move : stage.moves())
    for (const double number : rowOf(move)) *to++ = number;
  return owned(data, {stage.moves().size(), kColumnCount});
}

std::map<std::string, double> modesOf(const Stage& stage) {
  const gcode::Modal& modal = stage.parts().modal;
  return {{"inches", modal.inches},
          {"relative", modal.relative},
          {"absolute_centres", modal.absolute_centres},
          {"inverse_time", modal.inverse_time},
          {"retracts_to_r", modal.retracts_to_r},
          {"plane", modal.plane},
          {"system", modal.system},
          {"motion", modal.motion},
          {"feed", modal.feed},
          {"tool", modal.tool},
          {"tool_in_spindle", modal.tool_in_spindle}};
}

Row placeOf(const Stage& stage) {
  const machine::Place place = stage.parts().program.counted();
  return {place.x, place.y, place.z};
}

Row originOf(const Stage& stage) {
  const machine::Coordinates& coordinates = stage.parts().coordinates;
  return {coordinates.begin(0), coordinates.begin(1), coordinates.begin(2)};
}

using Numbers = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// Leads a bit along places: x, y, z, its radius and its slope in each row; without a radius it is
/// put there. Returns how deep it met wood on the way to each place.
nb::ndarray<nb::numpy, double> take(dry_run::Wood& wood, Numbers places, double graze) {
  const size_t count = places.shape(0);
  double* const met = new double[count]();
  const double* row = places.data();
  for (size_t i = 1; i < count; ++i) {
    const double* const next = row + places.shape(1);
    if (next[3] > 0)
      met[i] = wood.take({row[0], row[1], row[2]}, {next[0], next[1], next[2]}, {next[3], next[4]},
                         graze);
    row = next;
  }
  return owned(met, {count});
}

nb::ndarray<nb::numpy, float> heightsOf(const dry_run::Wood& wood) {
  const std::vector<float>& heights = wood.heights();
  float* const data = new float[heights.size()];
  std::copy(heights.begin(), heights.end(), data);
  return owned(data, {heights.size() / wood.columns(), wood.columns()});
}

using Words = std::map<std::string, double>;

/// A line as the firmware cuts it: each piece's letter, code and words. None where it halts.
std::vector<std::tuple<std::string, double, Words>> pieces(std::string line) {
  line += '\0';
  gcode::clean(line.data());
  std::vector<std::tuple<std::string, double, Words>> result;
  if (gcode::findMistake(line.data()).fault != gcode::Fault::kNone) return result;
  gcode::Pieces cut(line.data());
  for (gcode::Piece piece; cut.next(piece);) {
    Words words;
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      if (piece.words.has(letter)) words[std::string(1, letter)] = piece.words.value(letter);
    const std::string code = piece.letter == gcode::kNoLetter ? "" : std::string(1, piece.letter);
    result.emplace_back(code, piece.tenths / 10.0, words);
  }
  return result;
}

}  // namespace

NB_MODULE(_dry_run, module) {
  module.doc() = "The firmware runs a program, its motors simulated, as fast as the host computes.";
  using nb::arg;
  nb::list columns;
  for (const char* const name : kColumns) columns.append(name);
  module.attr("COLUMNS") = nb::tuple(columns);
  nb::class_<Stage>(module, "DryRun", "A machine with an empty memory, after power-on.")
      .def(nb::init<>())
      .def("send", &Stage::send, arg("lines"), nb::call_guard<nb::gil_scoped_release>(),
           "Sends lines, and returns when all are answered; behind an alarm they are left out.")
      .def("drain", &Stage::drain, nb::call_guard<nb::gil_scoped_release>(),
           "Lets the queued moves end.")
      .def("moves", &movesOf, "The moves so far, a row each; COLUMNS names the numbers.")
      .def("forget_ended", &Stage::forgetEnded,
           "Forgets the first moves, which have ended, and returns how many they were.")
      .def("said", &Stage::said, "What the machine said: line, text.")
      .def("modes", &modesOf, "The modes that the next line is read with.")
      .def("place", &placeOf, "Where the queue ends for the program: x, y, z [mm].")
      .def("origin", &originOf, "Where the program's coordinates begin: x, y, z [mm].")
      .def_prop_ro("seconds", &Stage::seconds, "Since power-on.")
      .def_prop_ro("answered", &Stage::answered, "How many lines were answered.")
      .def_prop_ro("is_halted", &Stage::isHalted, "Whether an alarm stopped it.");
  nb::class_<dry_run::Wood>(module, "Wood", "The wood of a sheet, from which a bit takes cells.")
      .def(nb::init<double, double, size_t, size_t, double>(), arg("left"), arg("low"),
           arg("columns"), arg("rows"), arg("cell"))
      .def("take", &take, arg("places"), arg("graze"),
           "Leads a bit along places; how deep it met wood on the way to each [mm].")
      .def("heights", &heightsOf, "Heights (rows, columns) of the wood that is left [mm].");
  module.def("pieces", &pieces, arg("line"),
             "A line as the firmware cuts it: letter, code, words; nothing where it halts.");
}
