#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "twin/export.hpp"

namespace twin {

/// What kind of thing went wrong. The kind decides the exit status of the program `twin`.
enum class ErrorCode {
  kUsage,        ///< the command line or a setting is wrong: exit status 2
  kProgram,      ///< the NC program is wrong: exit status 1
  kFile,         ///< a file cannot be read or written: exit status 1
  kModel,        ///< the MuJoCo model is missing, broken or became unstable: exit status 1
  kMachine,      ///< the machine refused or failed: exit status 1
  kHost,         ///< the computer has no memory or no thread left: exit status 1
  kInterrupted,  ///< the user stopped the run: exit status 130
};

/// An error that a user can act on: it says where, what was found and what was expected.
struct Error {
  ErrorCode code = ErrorCode::kProgram;
  std::string message;  ///< value with its unit, limit, and what to do; names no file and no line
  std::string file;     ///< file that is wrong; empty if the error is about no file
  int line = 0;         ///< line in this file, counted from 1; 0 if not known
  int column = 0;       ///< column in this line, counted from 1; 0 if not known
};

/// The error as one line of text, "square.nc:3:7: MESSAGE". Parts that are not known are left out.
TWIN_EXPORT std::string to_string(const Error& error);

/// Exit status with which a process should end after this error: 2 for kUsage, 130 for kInterrupted, 1
/// for all others.
TWIN_EXPORT int exit_status(const Error& error) noexcept;

/// The exception that the functions of <twin/...> throw. what() returns to_string(error()).
class TWIN_EXPORT Failure : public std::runtime_error {
 public:
  explicit Failure(Error error);
  const Error& error() const noexcept { return *error_; }

 private:
  std::shared_ptr<const Error> error_;  // shared, so that copying an exception cannot fail
};

}  // namespace twin
