#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/fuzz/chain/outcome.hpp"
#include "tests/fuzz/minimise.hpp"
#include "tests/fuzz/random_statistics.hpp"
#include "tests/fuzz/target.hpp"

// What tests/run and tests/random/run have of the fuzzing, without libFuzzer:
//
//   twin_fuzz findings FOLDER     each file of FOLDER/TARGET through its target
//   twin_fuzz show TARGET FILE    what a file means
//   twin_fuzz random COUNT SEED [FIRST]   random programs through the whole chain
//                                 (TWIN_FUZZ_EACH=1: each broken promise with its program, too)
//   twin_fuzz times FILE          time of each block of a case of the chain, beside that with stops
//   twin_fuzz minimise FILE TEXT  smaller bytes for the chain with a finding that says TEXT still
//   twin_fuzz bytes NUMBER SEED   the bytes of one of them, to standard output
namespace twin::fuzz {
namespace {

namespace fs = std::filesystem;

const std::array kTargets{&kReader, &kMachineFile, &kCsv,    &kOperator, &kJson,    &kTools,
                          &kJobs,   &kStore,       &kLearnt, &kHdf5,     &kSegment, &kChain};
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr unsigned kPatience = 200;  // for one file or one program [s]
#else
constexpr unsigned kPatience = 20;
#endif

/// What runs at the moment, for a hang.
std::string g_running;

void give_up(int /*signal*/) {
  static constexpr std::string_view kText = "does not end: ";
  static_cast<void>(!::write(STDERR_FILENO, kText.data(), kText.size()));
  static_cast<void>(!::write(STDERR_FILENO, g_running.data(), g_running.size()));
  std::_Exit(1);
}

std::vector<std::uint8_t> contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int run_findings(const fs::path& folder) {
  int count = 0;
  int broken = 0;
  for (const Target* target : kTargets) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / target->name, none)) {
      g_running = entry.path().string() + "\n";
      ::alarm(kPatience);
      ++count;
      try {
        target->run(contents(entry.path()));
      } catch (const Finding& finding) {
        ++broken;
        fmt::print("{}: {}\n", entry.path().string(), finding.what());
      }
    }
  }
  fmt::print("{} findings run again, {} of them still are one\n", count, broken);
  return count == 0 || broken > 0 ? 1 : 0;
}

int show_file(std::string_view name, const fs::path& file) {
  for (const Target* target : kTargets) {
    if (target->name == name) {
      const auto bytes = contents(file);
      const std::string text =
          target->show != nullptr ? target->show(bytes) : std::string(text_of(bytes));
      std::fwrite(text.data(), 1, text.size(), stdout);
      return 0;
    }
  }
  fmt::print(stderr, "no target is called {}\n", name);
  return 2;
}

/// Prints where a case of the chain spends its time, block by block.
int show_times(const fs::path& file) {
  const auto bytes = contents(file);
  const Case made = make_case(bytes);
  const Trajectory trajectory = follow(made);
  fmt::print("{:>5} {:>12} {:>12} {:>8}  times of blocks, and with a stop after each [s]\n", "line",
             "time", "with stops", "ratio");
  for (const Piece& piece : made.program.pieces) {
    const auto periods = std::count(trajectory.lines.begin(), trajectory.lines.end(), piece.line);
    const double time = static_cast<double>(periods) * made.machine.period;
    const double with_stop = reference_time(piece, made.machine);
    fmt::print("{:5} {:12.6f} {:12.6f} {:8.3f}\n", piece.line, time, with_stop,
               with_stop > 0.0 ? time / with_stop : 0.0);
  }
  return 0;
}

/// Whether each broken promise is printed as it is found.
bool says_each() {
  static const bool says = std::getenv("TWIN_FUZZ_EACH") != nullptr;
  return says;
}

void follow_random(RandomStatistics& statistics, std::uint64_t seed, std::uint64_t number) {
  const Case made = make_case(random_bytes(seed, number));
  const Outcome outcome = examine(made, number % 16 == 0);
  statistics.add(number, made, outcome);
  if (says_each()) {
    for (const Breach& breach : outcome.findings) {
      fmt::print(stderr, "program {}: {}\n", number, to_string(breach));
    }
  }
}

/// Random programs in as many threads as there are cores, with an eye on each.
class RandomRun {
 public:
  RandomRun(std::uint64_t first, std::uint64_t count, std::uint64_t seed)
      : next_(first),
        end_(first + count),
        seed_(seed),
        workers_(std::max(1U, std::thread::hardware_concurrency())) {}

  RandomStatistics run() {
    {
      std::vector<std::jthread> threads;
      for (Worker& worker : workers_) {
        threads.emplace_back([this, &worker] { work(worker); });
      }
      watch();
    }
    RandomStatistics all;
    for (const Worker& worker : workers_) {
      all.add(worker.statistics);
    }
    return all;
  }

 private:
  struct Worker {
    RandomStatistics statistics;
    std::atomic<std::uint64_t> number{0};
    std::atomic<bool> is_ready{false};
  };

  void work(Worker& worker) {
    while ((worker.number = next_++) < end_) {
      follow_random(worker.statistics, seed_, worker.number);
    }
    worker.is_ready = true;
  }

  /// Ends the process when a program takes longer than anybody's patience.
  void watch() {
    std::vector<std::uint64_t> before(workers_.size(), end_);
    unsigned waited = 0;
    while (!std::all_of(workers_.begin(), workers_.end(),
                        [](const Worker& worker) { return worker.is_ready.load(); })) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (++waited % (50 * kPatience) != 0) {
        continue;
      }
      for (std::size_t i = 0; i < workers_.size(); ++i) {
        if (!workers_[i].is_ready && workers_[i].number == before[i]) {
          fmt::print("program {} of seed {} does not end\n", before[i], seed_);
          std::fflush(stdout);
          std::_Exit(1);
        }
        before[i] = workers_[i].number;
      }
    }
  }

  std::atomic<std::uint64_t> next_;
  std::uint64_t end_;
  std::uint64_t seed_;
  std::deque<Worker> workers_;
};

int run_random(std::uint64_t count, std::uint64_t seed, std::uint64_t first) {
  const auto begin = std::chrono::steady_clock::now();
  const RandomStatistics all = RandomRun(first, count, seed).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double cpu = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  fmt::print("seed {}: {}\n{:.1f} s, {:.3f} ms of a core for a program\n", seed, all.text(),
             took.count(), 1e3 * cpu / static_cast<double>(count));
  return all.is_clean() ? 0 : 1;
}

int run(const std::vector<std::string>& words) {
  std::signal(SIGALRM, give_up);
  if (words.size() == 2 && words[0] == "findings") {
    return run_findings(words[1]);
  }
  if (words.size() == 3 && words[0] == "show") {
    return show_file(words[1], words[2]);
  }
  if (words.size() == 2 && words[0] == "times") {
    return show_times(words[1]);
  }
  if (words.size() >= 3 && words[0] == "random") {
    return run_random(std::stoull(words[1]), std::stoull(words[2]),
                      words.size() > 3 ? std::stoull(words[3]) : 0);
  }
  if (words.size() == 3 && words[0] == "minimise") {
    const auto bytes = minimise(contents(words[1]), words[2]);
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return 0;
  }
  if (words.size() == 3 && words[0] == "bytes") {
    const auto bytes = random_bytes(std::stoull(words[2]), std::stoull(words[1]));
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    return 0;
  }
  fmt::print(
      stderr,
      "twin_fuzz findings FOLDER | show TARGET FILE | random COUNT SEED [FIRST] | times FILE | "
      "minimise FILE TEXT | bytes NUMBER SEED\n");
  return 2;
}

}  // namespace
}  // namespace twin::fuzz

int main(int argc, char** argv) { return twin::fuzz::run({argv + 1, argv + argc}); }
