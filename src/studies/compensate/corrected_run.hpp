#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "motion/correction/correction_follower.hpp"
#include "studies/compensate/learning.hpp"
#include "twin/trace.hpp"

namespace twin::studies::compensate {

/// Which correction a run is to follow.
struct CorrectionWish {
  bool is_wanted = false;          ///< one of `file`, or one that is made now
  std::filesystem::path file;      ///< of a correction; empty: it is made now
  std::filesystem::path learning;  ///< folder in which runs are learnt from; empty: nothing is

  bool is_any() const { return is_wanted || !learning.empty(); }
};

/// Who waits for a correction that is made. Both may be empty.
struct CorrectionWatch {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1
};

/// The correction of a run: found before the run, made better of what the run has measured.
///
///   prepare()     reads the correction, or makes it; refuses one that does not fit
///   correction()  is what the run follows, and sink() gets its trace
///   learn_from()  leaves the correction of the next run in the folder
class CorrectedRun {
 public:
  /// Without any wish it has no correction.
  static Expected<CorrectedRun> prepare(const CorrectionWish& wish,
                                        const gcode::ProgramText& program,
                                        const config::MachineFile& machine,
                                        const std::optional<double>& feedrate,
                                        const CorrectionWatch& watch);

  /// Null: there is none.
  const std::shared_ptr<const motion::Correction>& correction() const noexcept {
    return correction_;
  }
  /// What the model expects of a correction that was made now; else empty.
  const std::string& remark() const noexcept { return remark_; }
  /// Gets the rows of the run's trace, whose default columns it needs; null where nothing is learnt.
  TraceSink* sink() const noexcept { return trace_.get(); }

  /// Puts correction() and sink() into a request: of a session, or of a run.
  template <class Request>
  void add_to(Request& request) const {
    request.correction = correction_;
    if (sink() != nullptr) {
      request.sinks.push_back(sink());
    }
  }

  /// Makes a better correction of what sink() has got, which must be a whole run.
  /// @returns a line on it; an empty one where nothing is learnt
  Expected<std::string> learn_from(const CorrectionWatch& watch);

 private:
  Expected<MadeCorrection> make(std::vector<Vec2> mismatch, const CorrectionWatch& watch) const;

  std::filesystem::path learning_;
  gcode::ProgramText program_;
  config::MachineFile machine_;
  std::optional<double> feedrate_;
  std::string remark_;
  std::shared_ptr<const motion::Correction> correction_;
  std::unique_ptr<MemoryTrace> trace_;
};

}  // namespace twin::studies::compensate
