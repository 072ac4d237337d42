#include "robot/pads_entry.hpp"

#include <algorithm>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_guides.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

PadText parse_pad(const Entry& entry, Diagnostics& diagnostics) {
  PadText pad;
  pad.frame = {entry.key.text, entry.key.span};
  const std::string what = "the pad of `" + entry.key.text + "`";
  const auto sizes = parse_vector(entry.value, dimension::length, 2, 2, what, diagnostics);
  if (!sizes) return pad;
  pad.width = (*sizes)[0];
  pad.height = (*sizes)[1];
  if (!(pad.width > 0.0) || !(pad.height > 0.0))
    diagnostics.add(wording::not_positive(entry.value.span, what, false));
  return pad;
}

void check_pads(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics) {
  const auto is_of_an_arm = [&model](const solver::Frame& frame) {
    const auto rolls = [&](const solver::Wheel& wheel) { return wheel.body == frame.body; };
    return frame.body > 0 && model.joint(frame.body - 1).actuated &&
           std::none_of(model.wheels().begin(), model.wheels().end(), rolls);
  };
  std::vector<std::string> of_arms;
  for (const solver::Frame& frame : model.frames()) {
    if (is_of_an_arm(frame)) of_arms.push_back(frame.name);
  }
  for (const PadText& pad : file.pads) {
    const std::optional<int> frame = model.find_frame(pad.frame.text);
    if (!frame) {
      diagnostics.add(wording::unknown_frame(pad.frame.span, "link or frame of an arm", pad.frame.text,
                                             of_arms, file.base.text));
    } else if (!is_of_an_arm(model.frames()[static_cast<std::size_t>(*frame)])) {
      diagnostics.add(wording::pad_off_the_arm(pad.frame.span, pad.frame.text));
    }
  }
}

}  // namespace zwang::lang
