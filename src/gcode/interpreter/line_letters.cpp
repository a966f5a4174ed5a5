#include "gcode/interpreter/line_letters.hpp"

#include "gcode/interpreter/modal_state.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {
namespace {

/// Letters of the motions that FANUC's probing or the spindle have a part in.
std::uint32_t letters_of_spindle_motion(MotionMode motion) {
  switch (motion) {
    case MotionMode::kSkip:
      return LineWords::set_of("P");
    case MotionMode::kThread:
      return LineWords::set_of("K");
    case MotionMode::kRigidTap:
      return LineWords::set_of("KI");
    case MotionMode::kThreadCycle:
      return LineWords::set_of("PIJKRQHEL");
    default:
      return 0;
  }
}

/// Letters that the motion in force takes besides X Y Z.
std::uint32_t letters_of_motion(const LineWords& words, const ModalState& state) {
  if (words.has(GGroup::kMotion)) {
    switch (words.g(GGroup::kMotion)) {
      case GWord::kCubicSpline:
        return LineWords::set_of("IJPQ");
      case GWord::kQuadraticSpline:
        return LineWords::set_of("IJQ");
      default:
        break;
    }
  }
  if (state.is_arc()) {
    return LineWords::set_of("IJKRP");
  }
  if (state.motion != MotionMode::kCycle) {
    return letters_of_spindle_motion(state.motion);
  }
  const std::uint32_t every = LineWords::set_of("RLK");
  switch (state.cycle) {
    case GWord::kChipBreak:
    case GWord::kPeckDrill:
      return every | LineWords::set_of("Q");
    case GWord::kTapLeft:
    case GWord::kTapRight:
    case GWord::kDrillDwell:
    case GWord::kBoreRapidOut:
    case GWord::kBoreDwell:
      return every | LineWords::set_of("P");
    default:
      return every;
  }
}

std::uint32_t letters_of_setting(GWord word) {
  switch (word) {
    case GWord::kSetOffsets:
      return LineWords::set_of("PLRIJQ");
    case GWord::kSecondHome:
      return LineWords::set_of("P");
    default:
      return 0;
  }
}

std::uint32_t letters_of_g(const LineWords& words) {
  std::uint32_t taken = 0;
  if (words.has(GGroup::kDwell)) {
    taken |= LineWords::set_of("P");
  }
  if (words.has(GGroup::kPathMode, GWord::kContinuous)) {
    taken |= LineWords::set_of("PQ");
  }
  if (words.has(GGroup::kSetting)) {
    taken |= letters_of_setting(words.g(GGroup::kSetting));
  }
  if (words.has(GGroup::kToolLength)) {
    taken |= LineWords::set_of("H");
  }
  if (words.has(GGroup::kCutterCompensation)) {
    taken |= LineWords::set_of("DL");
  }
  if (words.has(GGroup::kSpindleMode)) {
    taken |= LineWords::set_of("D");
  }
  if (words.has(GGroup::kWorkOffset, GWord::kExtendedWorkOffset) || words.has(GGroup::kDiameter)) {
    taken |= LineWords::set_of("P");
  }
  if (words.has(GGroup::kRotation, GWord::kRotation)) {
    taken |= LineWords::set_of("R");
  }
  if (words.has(GGroup::kSmoothness)) {
    taken |= LineWords::set_of("PE");
  }
  return taken;
}

std::uint32_t letters_of_m(const LineWords& words) {
  std::uint32_t taken = 0;
  if (words.has(MGroup::kInputOutput)) {
    taken |= LineWords::set_of("PQEL");
  }
  if (words.has(MGroup::kOverride)) {
    taken |= LineWords::set_of("P");
  }
  if (words.has(MGroup::kClamp)) {
    taken |= LineWords::set_of("P");
  }
  if (words.has(MGroup::kSpindle)) {
    taken |= LineWords::set_of("RPQ");
  }
  if (words.has(MGroup::kUserCommand) || words.has(MGroup::kMachineFunction)) {
    taken |= LineWords::set_of("PQRLED");
  }
  if (words.has(MGroup::kToolChange, MWord::kToolNumber)) {
    taken |= LineWords::set_of("Q");
  }
  return taken;
}

}  // namespace

std::uint32_t letters_taken(const LineWords& words, const ModalState& state) noexcept {
  return letters_of_motion(words, state) | letters_of_g(words) | letters_of_m(words);
}

}  // namespace twin::gcode
