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
#include <memory>
#include <tuple>

#include "stage.h"
#include "wood.h"

namespace nb = nanobind;

namespace {

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

class DryRun {
 public:
  void send(const std::vector<std::string>& lines) { stage_.send(lines); }
  void drain() { stage_.drain(); }
  double seconds() const { return stage_.seconds(); }
  int answered() const { return stage_.answered(); }
  bool isHalted() const { return stage_.isHalted(); }

  std::vector<std::pair<int, std::string>> said() const {
    std::vector<std::pair<int, std::string>> result;
    for (const dry_run::Said& said : stage_.said()) result.emplace_back(said.line, said.text);
    return result;
  }

  nb::ndarray<nb::numpy, double> moves() const {
    const size_t count = stage_.moves().size();
    double* const data = new double[count * kColumnCount];
    nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
    double* to = data;
    for (const dry_run::Queued& move : stage_.moves())
      for (const double number : rowOf(move)) *to++ = number;
    return nb::ndarray<nb::numpy, double>(data, {count, size_t(kColumnCount)}, owner);
  }

  size_t forgetEnded() { return stage_.forgetEnded(); }

  /// The modes that the next line is read with.
  std::map<std::string, double> modes() const {
    const gcode::Modal& modal = stage_.parts().modal;
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

  /// Where the program believes the bit to be, and where its coordinates begin [mm].
  std::vector<double> place() const {
    const machine::Place place = stage_.parts().program.counted();
    return {place.x, place.y, place.z};
  }
  std::vector<double> origin() const {
    const machine::Coordinates& coordinates = stage_.parts().coordinates;
    return {coordinates.begin(0), coordinates.begin(1), coordinates.begin(2)};
  }

 private:
  dry_run::Stage stage_;
};

using Numbers = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Map = nb::ndarray<nb::numpy, float>;
using Depths = nb::ndarray<nb::numpy, double>;

/// A bit on its way through the wood of a sheet.
class Cutting {
 public:
  Cutting(std::pair<double, double> corner, std::pair<size_t, size_t> shape, double cell,
          double graze)
      : wood_(corner.first, corner.second, shape.second, shape.first, cell),
        rows_(shape.first),
        columns_(shape.second),
        graze_(graze) {}

  /// Leads it along places: x, y, z, its radius and its slope in each row; without a radius it is
  /// put there. Returns how deep it met wood on the way to each place.
  Depths take(Numbers places) {
    const size_t count = places.shape(0);
    double* const met = new double[count]();
    nb::capsule owner(met, [](void* p) noexcept { delete[] static_cast<double*>(p); });
    const double* row = places.data();
    for (size_t i = 1; i < count; ++i) {
      const double* const next = row + places.shape(1);
      if (next[3] > 0)
        met[i] = wood_.take({row[0], row[1], row[2]}, {next[0], next[1], next[2]},
                            {next[3], next[4]}, graze_);
      row = next;
    }
    return Depths(met, {count}, owner);
  }

  Map heights() const {
    float* const data = new float[wood_.heights().size()];
    std::copy(wood_.heights().begin(), wood_.heights().end(), data);
    nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<float*>(p); });
    return Map(data, {rows_, columns_}, owner);
  }

 private:
  dry_run::Wood wood_;
  size_t rows_, columns_;
  double graze_;
};

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
  nb::class_<DryRun>(module, "DryRun", "A machine with an empty memory, after power-on.")
      .def(nb::init<>())
      .def("send", &DryRun::send, arg("lines"), nb::call_guard<nb::gil_scoped_release>(),
           "Sends lines, and returns when all are answered; behind an alarm they are left out.")
      .def("drain", &DryRun::drain, nb::call_guard<nb::gil_scoped_release>(),
           "Lets the queued moves end.")
      .def("moves", &DryRun::moves, "The moves so far, a row each; COLUMNS names the numbers.")
      .def("forget_ended", &DryRun::forgetEnded,
           "Forgets the first moves, which have ended, and returns how many they were.")
      .def("said", &DryRun::said, "What the machine said: line, text.")
      .def("modes", &DryRun::modes, "The modes that the next line is read with.")
      .def("place", &DryRun::place, "Where the queue ends for the program: x, y, z [mm].")
      .def("origin", &DryRun::origin, "Where the program's coordinates begin: x, y, z [mm].")
      .def_prop_ro("seconds", &DryRun::seconds, "Since power-on.")
      .def_prop_ro("answered", &DryRun::answered, "How many lines were answered.")
      .def_prop_ro("is_halted", &DryRun::isHalted, "Whether an alarm stopped it.");
  nb::class_<Cutting>(module, "Cutting", "A bit on its way through the wood of a sheet.")
      .def(nb::init<std::pair<double, double>, std::pair<size_t, size_t>, double, double>(),
           arg("corner"), arg("shape"), arg("cell"), arg("graze"))
      .def("take", &Cutting::take, arg("places"),
           "Leads it along places; how deep it met wood on the way to each [mm].")
      .def("heights", &Cutting::heights, "Heights (rows, columns) of the wood behind it [mm].");
  module.def("pieces", &pieces, arg("line"),
             "A line as the firmware cuts it: letter, code, words; nothing where it halts.");
}
