#include "pictures/plot/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/descriptor.hpp"
#include "pictures/figure/workshop.hpp"
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
  Descriptor complaints;
};

/// Becomes gnuplot; in the child, between fork and exec. It is a process group of its own, so that a
/// signal to the group of this program leaves it to this program, with which it dies in any case.
///
/// @param parent      that it dies with
/// @param complaints  its stderr
/// @param refusal     gets errno when gnuplot cannot be started
[[noreturn]] void become_gnuplot(const char* directory, char* const* arguments, pid_t parent,
                                 int complaints, int refusal) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(1);  // the parent was gone before that was in force
  }
  for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) {
    std::signal(number, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 && ::dup2(nothing, STDOUT_FILENO) >= 0 &&
      ::dup2(complaints, STDERR_FILENO) >= 0 && ::chdir(directory) == 0) {
    ::execvp(arguments[0], arguments);
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = ::write(refusal, &reason, sizeof(reason));
  ::_exit(1);
}

/// A pipe: read end, write end.
Expected<std::pair<Descriptor, Descriptor>> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return start_error(errno);
  }
  return std::pair(Descriptor(ends[0]), Descriptor(ends[1]));
}

/// A script to be run, and whether for a paper.
struct GnuplotRun {
  std::string script;  ///< file name
  bool is_for_paper = false;
};

Expected<Child> start(const std::filesystem::path& directory, const GnuplotRun& drawing) {
  TWIN_TRY(auto complaints, make_pipe());
  TWIN_TRY(auto refusal, make_pipe());
  std::string program = "gnuplot";
  std::string option = "-e";
  std::string definition = drawing.is_for_paper ? "paper=1" : "paper=0";
  std::string script = drawing.script;
  const std::array<char*, 5> arguments{program.data(), option.data(), definition.data(),
                                       script.data(), nullptr};
  const pid_t parent = ::getpid();
  Child child;
  child.pid = ::fork();
  if (child.pid == 0) {
    become_gnuplot(directory.c_str(), arguments.data(), parent, complaints.second.get(),
                   refusal.second.get());
  }
  if (child.pid < 0) {
    return start_error(errno);
  }
  complaints.second = Descriptor();
  refusal.second = Descriptor();
  int reason = 0;
  if (::read(refusal.first.get(), &reason, sizeof(reason)) == sizeof(reason)) {
    ::waitpid(child.pid, nullptr, 0);
    return start_error(reason);
  }
  child.complaints = std::move(complaints.first);
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
/// @param drawing  of a script in that directory
/// @returns an Error when gnuplot is missing or fails, with the first line of its complaint
Expected<void> run_gnuplot(const std::filesystem::path& directory, const GnuplotRun& drawing) {
  TWIN_TRY(auto child, start(directory, drawing));
  const std::string complaints = listen(child.complaints.get());
  int status = 0;
  while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return {};
  }
  const std::string line = telling_line(complaints);
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, "gnuplot failed: " + (line.empty() ? "no message" : line),
            (directory / drawing.script).lexically_normal().string(), 0, 0});
}

/// The same in a thread, which nothing may escape.
Expected<void> run_guarded(const std::filesystem::path& directory, const GnuplotRun& drawing) {
  try {
    return run_gnuplot(directory, drawing);
  } catch (const std::exception& error) {
    return fail(ErrorCode::kFile, std::string("gnuplot cannot be run: ") + error.what());
  }
}

/// Runs several scripts, two at a time. @returns the first error, after all have ended
Expected<void> run_gnuplot(const std::filesystem::path& directory,
                           std::span<const GnuplotRun> scripts) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Expected<void> result;
  const auto work = [&] {
    for (std::size_t i = next++; i < scripts.size(); i = next++) {
      auto done = run_guarded(directory, scripts[i]);
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

/// Whether a picture ends as one of its kind does.
bool has_its_end(const fs::path& picture) {
  const std::string_view end = picture.extension() == ".png"
                                   ? std::string_view("IEND\xAE\x42\x60\x82")
                               : picture.extension() == ".pdf" ? "%%EOF"
                                                               : "</svg>";
  constexpr std::streamoff most = 64;
  std::ifstream in(picture, std::ios::binary | std::ios::ate);
  in.seekg(-std::min<std::streamoff>(most, in.tellg()), std::ios::end);
  const std::string last{std::istreambuf_iterator<char>(in), {}};
  return last.find(end) != std::string::npos;
}

/// Puts the beginning of 1970 for the time of drawing, which a PDF tells: the same run, the same bytes.
void take_date_out(const fs::path& pdf) {
  constexpr std::string_view key = "/CreationDate (D:";
  std::fstream file(pdf, std::ios::binary | std::ios::in | std::ios::out);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (const std::size_t at = text.find(key); at != std::string::npos) {
    file.clear();
    file.seekp(static_cast<std::streamoff>(at + key.size()));
    file << "19700101000000";
  }
}

/// Names of the pictures that a script makes.
std::vector<std::string> pictures_of(const Script& script) {
  return {script.name + ".png", script.name + ".svg", script.name + ".pdf"};
}

/// A picture that gnuplot left out although it said nothing, or cut short, as on a full disk.
Expected<void> check_pictures(const fs::path& folder, std::span<const std::string> names) {
  for (const std::string& name : names) {
    std::error_code error;
    if (fs::file_size(folder / name, error) == 0 || error || !has_its_end(folder / name)) {
      return tl::unexpected<Error>(Error{ErrorCode::kFile, "gnuplot did not write this picture",
                                         (folder / name).string(), 0, 0});
    }
  }
  return {};
}

/// Shows the data of a folder under the same names in a folder inside it, where scripts read them.
Expected<void> link_data(const fs::path& folder, const fs::path& inside) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".csv") {
      fs::create_symlink(fs::path("..") / entry.path().filename(), inside / entry.path().filename(),
                         error);
    }
    if (error) {
      break;
    }
  }
  return error ? file_error(folder, "draw in this folder", error.value()) : Expected<void>();
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
  TWIN_TRY(results::CsvFile file,
           results::CsvFile::create(folder / (name + ".csv"), folder / (name + ".csv.tmp"), columns,
                                    OnAbandon::kRemove, Durability::kCached));
  for (std::size_t i = 0; i < table.rows(); ++i) {
    TWIN_CHECK(file.write(table.row(i)));
  }
  return file.commit();
}

Expected<std::vector<fs::path>> draw(const fs::path& folder, std::span<const Script> scripts,
                                     Paper paper) {
  TWIN_TRY(const Workshop workshop, Workshop::open(folder));
  std::vector<std::string> names;
  std::vector<fs::path> pictures;
  std::vector<fs::path> old;
  std::vector<GnuplotRun> drawings;
  for (const Script& script : scripts) {
    TWIN_CHECK(write_whole_file(folder / (script.name + ".gp"), script.text, Durability::kCached));
    drawings.push_back({"../" + script.name + ".gp", false});
    if (paper == Paper::kToo) {
      drawings.push_back({"../" + script.name + ".gp", true});
    }
    for (const std::string& name : pictures_of(script)) {
      old.push_back(folder / name);
      if (paper == Paper::kToo || !name.ends_with(".pdf")) {
        names.push_back(name);
        pictures.push_back(folder / name);
      }
    }
  }
  remove_all(old);  // no older picture may pass for one of this run
  TWIN_CHECK(link_data(folder, workshop.folder()));
  TWIN_CHECK(run_gnuplot(workshop.folder(), drawings));
  TWIN_CHECK(check_pictures(workshop.folder(), names));
  for (const std::string& name : names) {
    if (name.ends_with(".pdf")) {
      take_date_out(workshop.folder() / name);
    }
  }
  TWIN_CHECK(workshop.deliver(names));
  return pictures;
}

}  // namespace twin::pictures
