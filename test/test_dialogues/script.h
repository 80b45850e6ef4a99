// A dialogue as text: lines to send, lines that must come back, questions to the simulated machine.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

/// A line of a dialogue.
struct Step {
  enum Kind {
    kSend,     ///< `-> text`: a line with its end
    kSendRaw,  ///< `>> text`: characters alone; ^X is ctrl-X, ^N a line end, ^M CR, ^H 0x84, ^0 to
               ///< ^4 0x90 to 0x94, ^J 0x85, ^5 to ^9 0x95 to 0x99, ^A to ^D 0x9A to 0x9D
    kExpect,   ///< `<- text [within t]`: the next line, reports aside
    kSkipTo,   ///< `<* text [within t]`: some later line; those before are passed over
    kAsk,      ///< `~~ question`: of the simulated machine
  } kind;
  std::string text;
  std::string place;  ///< file and line of this step
};

/// The steps of a dialogue. Empty lines and lines that begin with `;` are left out.
/// `~~ include FILE` is replaced by the steps of a file in the same folder.
inline std::vector<Step> readScript(const std::string& folder, const std::string& name) {
  std::ifstream text(folder + "/" + name);
  if (!text) throw std::runtime_error("cannot read " + folder + "/" + name);
  std::vector<Step> steps;
  std::string line;
  const std::string kInclude = "~~ include ";
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line[0] == ';') continue;
    if (line.compare(0, kInclude.size(), kInclude) == 0) {
      const std::vector<Step> more = readScript(folder, line.substr(kInclude.size()));
      steps.insert(steps.end(), more.begin(), more.end());
      continue;
    }
    const std::string mark = line.substr(0, 2);
    Step step = {Step::kSend, line.size() > 3 ? line.substr(3) : "",
                 name + ":" + std::to_string(number)};
    if (mark == ">>")
      step.kind = Step::kSendRaw;
    else if (mark == "<-")
      step.kind = Step::kExpect;
    else if (mark == "<*")
      step.kind = Step::kSkipTo;
    else if (mark == "~~")
      step.kind = Step::kAsk;
    else if (mark != "->")
      throw std::runtime_error(name + ":" + std::to_string(number) +
                               ": begin with -> >> <- <* ~~ ;");
    steps.push_back(step);
  }
  return steps;
}
