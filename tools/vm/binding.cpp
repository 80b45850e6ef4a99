// The virtual machine for Python: a world, and a firmware that drives it.
#ifndef _WIN32
#include <dlfcn.h>
#endif
#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <optional>
#include <tuple>

#include "brain/host_brain.h"

namespace nb = nanobind;

namespace {

using Pair = std::pair<double, double>;
using CutRow = std::tuple<int, double, double, double, double>;

/// Finds the maker of a simulated Mega's brain in mega.so, beside this module; null on Windows.
void* megaBrain() {
#ifdef _WIN32
  return nullptr;
#else
  Dl_info here;
  dladdr(reinterpret_cast<void*>(&megaBrain), &here);
  const std::string module = here.dli_fname;
  const std::string path = module.substr(0, module.rfind('/') + 1) + "mega.so";
  void* const mega = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  return mega ? dlsym(mega, "megaBrain") : nullptr;
#endif
}

std::unique_ptr<brain::Brain> megaFor(world::World& world, const std::string& elf,
                                      const std::string& bootloader) {
  void* const make = megaBrain();
  if (!make)
    throw std::runtime_error(
        "the lab has no simulated Mega here; install libsimavr-dev and libelf-dev, and build the "
        "lab again (tools/setup does both)");
  using Make = brain::Brain*(world::World&, const std::string&, const std::string&);
  return std::unique_ptr<brain::Brain>(reinterpret_cast<Make*>(make)(world, elf, bootloader));
}

std::unique_ptr<brain::Brain> brainFor(world::World& world, const std::optional<std::string>& elf,
                                       const std::string& bootloader, int shield) {
  if (!elf) return std::make_unique<brain::HostBrain>(world);
  std::unique_ptr<brain::Brain> mega = megaFor(world, *elf, bootloader);
  mega->setShield(shield);
  return mega;
}

world::Axis axisNamed(const std::string& name) {
  if (name == "left") return world::kLeft;
  if (name == "right") return world::kRight;
  if (name == "z") return world::kZ;
  throw nb::value_error("an axis is left, right or z");
}

/// A machine in its garage, with the firmware that drives it.
class VirtualMachine {
 public:
  VirtualMachine(const std::map<std::string, double>& numbers, double friction, unsigned seed,
                 double paid_out, const std::optional<std::string>& elf,
                 const nb::bytes& bootloader, bool over_top, int shield)
      : world_({numbers, friction, seed, over_top}, paid_out),
        brain_(brainFor(world_, elf, {bootloader.c_str(), bootloader.size()}, shield)) {}

  void advance(int milliseconds) { brain_->advance(milliseconds); }
  void start() { brain_->start(); }
  void stop() { brain_->stop(); }
  void cutPower(unsigned draw) { brain_->cutPower(draw); }
  bool isRunning() const { return brain_->isRunning(); }
  void send(const nb::bytes& characters) { brain_->send({characters.c_str(), characters.size()}); }
  nb::bytes takeSaid() {
    const std::string said = brain_->takeSaid();
    return nb::bytes(said.data(), said.size());
  }

  nb::bytes eeprom() const {
    const std::vector<uint8_t> bytes = brain_->eeprom();
    return nb::bytes(bytes.data(), bytes.size());
  }
  void setEeprom(const nb::bytes& bytes) {
    if (brain_->isRunning()) throw nb::value_error("stop the machine before its memory is changed");
    if (bytes.size() != 4096) throw nb::value_error("an EEPROM of the Mega has 4096 bytes");
    const uint8_t* const data = reinterpret_cast<const uint8_t*>(bytes.c_str());
    brain_->setEeprom({data, data + bytes.size()});
  }

  double seconds() const { return world_.seconds(); }
  Pair sled() const { return {world_.sled().place().x(), world_.sled().place().y()}; }
  Pair chains() const { return {world_.travel(world::kLeft), world_.travel(world::kRight)}; }
  double across() const { return world_.across().pull.norm(); }
  double height() const { return world_.travel(world::kZ); }
  int count(const std::string& axis) { return world_.count(axisNamed(axis)); }
  int duty(const std::string& axis) const { return world_.duty(axisNamed(axis)); }

  std::vector<CutRow> cuts() {
    std::vector<CutRow> rows;
    for (const world::Cut& cut : world_.sheet().cuts())
      rows.emplace_back(cut.plunge, cut.seconds, cut.x, cut.y, cut.depth);
    return rows;
  }
  void replaceSheet() { world_.sheet().replace(); }

  void hookAcross(const std::string& axis, double slack, double beyond) {
    world_.hookAcross(axisNamed(axis), slack, beyond);
  }
  void slip(const std::string& axis, double mm) { world_.slip(axisNamed(axis), mm); }
  void set(const std::string& number, double value) { world_.set(number, value); }
  void setWire(const std::string& axis, const std::string& fault, bool is_so) {
    world::Wires& wires = world_.wires(axisNamed(axis));
    const std::map<std::string, bool*> faults = {{"motor_reversed", &wires.motor_reversed},
                                                 {"motor_unplugged", &wires.motor_unplugged},
                                                 {"encoder_reversed", &wires.encoder_reversed},
                                                 {"encoder_unplugged", &wires.encoder_unplugged},
                                                 {"channel_lost", &wires.channel_lost},
                                                 {"blocked", &wires.blocked},
                                                 {"driver_complains", &wires.driver_complains}};
    const auto found = faults.find(fault);
    if (found == faults.end()) throw nb::value_error(("no wire has the fault " + fault).c_str());
    *found->second = is_so;
  }
  void setMotorSupply(double volts) { world_.weakenSupply(world::MotorConstants().supply - volts); }

 private:
  world::World world_;
  std::unique_ptr<brain::Brain> brain_;
};

/// Hands and faults that act on a machine.
void bindFaults(nb::class_<VirtualMachine>& machine) {
  using nb::arg;
  machine
      .def("hook_across", &VirtualMachine::hookAcross, arg("axis"), arg("slack"),
           arg("beyond") = 12.7,
           "Takes the sled off and hooks a chain on the other sprocket, so many mm of links past "
           "12 o'clock, with so much slack [mm] beyond the motor gap.")
      .def("slip", &VirtualMachine::slip, arg("axis"), arg("mm"),
           "A chain jumps on its sprocket: so much more is paid out than was counted.")
      .def("set", &VirtualMachine::set, arg("number"), arg("value"),
           "Gives a number of the judge's machine a new value.")
      .def("set_wire", &VirtualMachine::setWire, arg("axis"), arg("fault"), arg("is_so"),
           "A fault: motor_reversed, motor_unplugged, encoder_reversed, encoder_unplugged, "
           "channel_lost, blocked, driver_complains.")
      .def("set_motor_supply", &VirtualMachine::setMotorSupply, arg("volts"), "12 if all is well.");
}

}  // namespace

NB_MODULE(_vm, module) {
  module.doc() = "The virtual machine: motors, chains, sled and sheet, driven by the firmware.";
  using nb::arg;
  nb::class_<VirtualMachine> machine(
      module, "VirtualMachine",
      "A machine in its garage. numbers: what differs from the judge's "
      "default machine; friction [N] of the sled; seed draws the motors, 0: "
      "as they are meant to be; paid_out [mm] of both chains at first; elf: "
      "the flashed program, else the firmware built for the host; bootloader: the HEX file of what "
      "the "
      "Mega starts first, so that it can be flashed over its line; over_top: the chains leave over "
      "the top of the sprockets, else below; shield: N of v1.N, 2 or 3, whose drivers the firmware "
      "hears complain. The host's build hears them on every shield.");
  machine
      .def(nb::init<const std::map<std::string, double>&, double, unsigned, double,
                    const std::optional<std::string>&, const nb::bytes&, bool, int>(),
           arg("numbers"), nb::kw_only(), arg("friction") = 0.0, arg("seed") = 0,
           arg("paid_out") = 1651.0, arg("elf") = nb::none(), arg("bootloader") = nb::bytes("", 0),
           arg("over_top") = true, arg("shield") = 2)
      .def("advance", &VirtualMachine::advance, arg("milliseconds"),
           nb::call_guard<nb::gil_scoped_release>(), "Lets time pass.")
      .def("start", &VirtualMachine::start, "Power comes, or the reset button is let go.")
      .def("stop", &VirtualMachine::stop, "Power goes at once. The EEPROM keeps what it has.")
      .def("cut_power", &VirtualMachine::cutPower, arg("draw") = 0,
           "As stop(); a byte that is being written is left half written, by the bits of `draw`.")
      .def_prop_ro("is_running", &VirtualMachine::isRunning)
      .def("send", &VirtualMachine::send, arg("characters"),
           "Puts characters on the line; they arrive at 57,600 baud.")
      .def("take_said", &VirtualMachine::takeSaid, "All that was said since this was last asked.")
      .def_prop_rw("eeprom", &VirtualMachine::eeprom, &VirtualMachine::setEeprom)
      .def_prop_ro("seconds", &VirtualMachine::seconds, "Since the world began.")
      .def_prop_ro("sled", &VirtualMachine::sled,
                   "(x, y) [mm] of the bit from the middle of the sheet.")
      .def_prop_ro("chains", &VirtualMachine::chains, "[mm] of nominal links, left and right.")
      .def_prop_ro("across", &VirtualMachine::across,
                   "[N] Pull of a chain hooked across on its motor.")
      .def_prop_ro("height", &VirtualMachine::height, "[mm] of the bit above the sheet's face.")
      .def("count", &VirtualMachine::count, arg("axis"), "Encoder counts since the world began.")
      .def("duty", &VirtualMachine::duty, arg("axis"), "-255 to 255; positive winds in.")
      .def("cuts", &VirtualMachine::cuts,
           "Where the bit was in the sheet: rows of plunge, seconds, x, y, depth [mm].")
      .def("replace_sheet", &VirtualMachine::replaceSheet, "A new sheet lies on the frame.");
  bindFaults(machine);
}
