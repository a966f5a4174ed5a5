#pragma once

#include <string>
#include <string_view>

#include "runtime/operator_panel.hpp"

namespace twin::operator_station {

/// Answers one line of the control socket and does what it says: one line of JSON, with no newline.
///
///   override 50   feed override, 0 to 200 %; 0 holds
///   hold          feed hold
///   resume        ends the feed hold
///   status        what the motion shows
///
/// Every answer to a command that is understood is the status; any other has the key `error`.
std::string answer(std::string_view line, runtime::OperatorPanel& panel);

/// Does what a key of the keyboard means: + and - by 10 %, 1 to 9 for 10 to 90 %, 0 for 100 %,
/// space holds and resumes. Other keys do nothing.
void press(char key, runtime::OperatorPanel& panel);

/// The line that stands on the terminal while it moves.
std::string status_line(const runtime::OperatorPanel& panel);

}  // namespace twin::operator_station
