#include "pictures/plot/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "core/atomic_file.hpp"
#include "results/trace/csv_file.hpp"

namespace twin::pictures {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostComplaint = 4096;  // bytes of stderr that are kept

tl::unexpected<Error> start_error(int reason) {
  if (reason == ENOENT) {
    return fail(
        ErrorCode::kFile,
        "gnuplot is not installed, so there are no figures; install package gnuplot-nox or use "
        "--no-plots");
  }
  return fail(ErrorCode::kFile,
              fmt::format("cannot start gnuplot: {}", std::generic_category().message(reason)));
}

/// A child process whose stderr ends in a pipe.
struct Child {
  pid_t pid = -1;
  int complaints = -1;
};

Expected<Child> start(const std::filesystem::path& directory, const std::string& script) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    return start_error(errno);
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
  std::string program = "gnuplot";
  std::string argument = script;
  const std::array<char*, 3> argv{program.data(), argument.data(), nullptr};
  Child child;
  const int status =
      ::posix_spawnp(&child.pid, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  if (status != 0) {
    ::close(pipe[0]);
    return start_error(status);
  }
  child.complaints = pipe[0];
  return child;
}

/// Everything the child says on stderr, up to a bound; ends when the child closes it.
std::string listen(int descriptor) {
  std::string text;
  std::array<char, 1024> piece{};
  for (;;) {
    const ssize_t got = ::read(descriptor, piece.data(), piece.size());
    if (got > 0) {
      if (text.size() < kMostComplaint) {
        text.append(piece.data(), static_cast<std::size_t>(got));
      }
    } else if (got == 0 || errno != EINTR) {
      return text;
    }
  }
}

/// The line that says what is wrong: gnuplot marks it with "line N:", after an echo of the command.
std::string telling_line(const std::string& text) {
  std::string first;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    if (line.find(" line ") != std::string::npos) {
      return line;
    }
    if (first.empty() && line.find_first_not_of(" \t\r") != std::string::npos) {
      first = line;
    }
    begin = end + 1;
  }
  return first;
}

/// Runs "gnuplot SCRIPT" in a directory and waits for it.
///
/// @param script  file name in that directory
/// @returns an Error when gnuplot is missing or fails, with the first line of its complaint
Expected<void> run_gnuplot(const std::filesystem::path& directory, const std::string& script) {
  TWIN_TRY(auto child, start(directory, script));
  const std::string complaints = listen(child.complaints);
  ::close(child.complaints);
  int status = 0;
  while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return {};
  }
  const std::string line = telling_line(complaints);
  return tl::unexpected<Error>(Error{ErrorCode::kFile,
                                     "gnuplot failed: " + (line.empty() ? "no message" : line),
                                     (directory / script).string(), 0, 0});
}

/// Runs several scripts, two at a time. @returns the first error, after all have ended
Expected<void> run_gnuplot(const std::filesystem::path& directory,
                           std::span<const std::string> scripts) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Expected<void> result;
  const auto work = [&] {
    for (std::size_t i = next++; i < scripts.size(); i = next++) {
      auto done = run_gnuplot(directory, scripts[i]);
      const std::lock_guard lock(mutex);
      if (!done && result) {
        result = std::move(done);
      }
    }
  };
  std::jthread second(work);
  work();
  second.join();
  return result;
}

/// A picture that gnuplot left out although it said nothing, as on a full disk.
Expected<void> check_pictures(const std::vector<fs::path>& pictures) {
  for (const fs::path& picture : pictures) {
    std::error_code error;
    if (fs::file_size(picture, error) == 0 || error) {
      return tl::unexpected<Error>(
          Error{ErrorCode::kFile, "gnuplot did not write this picture", picture.string(), 0, 0});
    }
  }
  return {};
}

void remove_all(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files) {
    fs::remove(file, ignored);
  }
}

}  // namespace

Expected<void> write_table(const std::filesystem::path& folder, const std::string& name,
                           std::span<const std::string_view> columns, const results::Table& table) {
  TWIN_TRY(results::CsvFile file, results::CsvFile::create(folder / (name + ".csv"),
                                                           folder / (name + ".csv.tmp"), columns));
  for (std::size_t i = 0; i < table.rows(); ++i) {
    TWIN_CHECK(file.write(table.row(i)));
  }
  return file.commit();
}

Expected<std::vector<fs::path>> draw(const fs::path& folder, std::span<const Script> scripts) {
  std::vector<fs::path> pictures;
  std::vector<std::string> names;
  for (const Script& script : scripts) {
    names.push_back(script.name + ".gp");
    pictures.push_back(folder / (script.name + ".png"));
    pictures.push_back(folder / (script.name + ".svg"));
    TWIN_CHECK(write_whole_file(folder / names.back(), script.text));
  }
  remove_all(pictures);  // no older picture may pass for one of this run
  auto drawn = run_gnuplot(folder, names).and_then([&] { return check_pictures(pictures); });
  if (!drawn) {
    remove_all(pictures);
    return tl::unexpected(std::move(drawn.error()));
  }
  return pictures;
}

}  // namespace twin::pictures
