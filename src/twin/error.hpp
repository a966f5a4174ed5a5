#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "twin/export.hpp"

namespace twin {

/// What kind of thing went wrong; decides the exit status.
enum class ErrorCode {
  kUsage,        ///< the command line or a setting is wrong: exit status 2
  kProgram,      ///< the NC program is wrong: exit status 1
  kFile,         ///< a file cannot be read or written: exit status 1
  kModel,        ///< the MuJoCo model is missing, broken or became unstable: exit status 1
  kMachine,      ///< the machine refused or failed: exit status 1
  kInterrupted,  ///< the user stopped the run: exit status 1
};

/// An error a user can act on: where it is, what was found, what was expected.
struct Error {
  ErrorCode code = ErrorCode::kProgram;
  std::string message;  ///< found value with unit, limit, what to do; no file name and no line
  std::string file;     ///< file it is about, or empty
  int line = 0;         ///< line in that file from 1, or 0
  int column = 0;       ///< column in that line from 1, or 0
};

/// "file:line:column: message", leaving out what is not known.
TWIN_EXPORT std::string to_string(const Error& error);

/// Exit status of the process for an error: 2 for bad usage, else 1.
TWIN_EXPORT int exit_status(const Error& error) noexcept;

/// The exception that the functions of <twin/...> throw. Its what() is to_string(error()).
class TWIN_EXPORT Failure : public std::runtime_error {
 public:
  explicit Failure(Error error);
  const Error& error() const noexcept { return *error_; }

 private:
  std::shared_ptr<const Error> error_;  // shared, so that copying an exception cannot fail
};

}  // namespace twin
