#include "tests/support/terminal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace tandem::test {

using namespace std::chrono_literals;

void Terminal::feed(std::string_view bytes) {
  pending_ += bytes;
  std::size_t at = 0;
  while (at < pending_.size()) {
    const char c = pending_[at];
    if (c == '\x1b') {
      if (at + 1 >= pending_.size()) break;
      if (pending_[at + 1] != '[') {
        at += 2;
        continue;
      }
      std::size_t end = at + 2;
      while (end < pending_.size() && (pending_[end] < '@' || pending_[end] > '~')) ++end;
      if (end == pending_.size()) break;
      const std::string number = pending_.substr(at + 2, end - at - 2);
      command(pending_[end], static_cast<std::size_t>(std::strtoul(number.c_str(), nullptr, 10)), !number.empty());
      at = end + 1;
      continue;
    }
    if (c == '\r') {
      column_ = 0;
    } else if (c == '\n') {
      down();
    } else if (c == '\b') {
      column_ -= column_ > 0 ? 1 : 0;
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      const auto lead = static_cast<unsigned char>(c);
      const std::size_t size = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
      if (at + size > pending_.size()) break;
      put(pending_.substr(at, size));
      at += size;
      continue;
    }
    ++at;
  }
  pending_.erase(0, at);
}

void Terminal::put(std::string cell) {
  if (column_ == columns_) {
    lines_[row_].continues = true;
    wraps_.push_back(text_of(lines_[row_]));
    column_ = 0;
    down();
  }
  auto& cells = lines_[row_].cells;
  if (cells.size() <= column_) cells.resize(column_ + 1, " ");
  cells[column_++] = std::move(cell);
}

void Terminal::down() {
  if (++row_ == lines_.size()) lines_.emplace_back();
}

void Terminal::command(char what, std::size_t number, bool given) {
  const std::size_t n = std::max<std::size_t>(1, number);
  switch (what) {
    case 'A':
      row_ = std::max(top(), row_ - std::min(row_, n));
      break;
    case 'B':
      row_ = std::min(lines_.size() - 1, row_ + n);
      break;
    case 'C':
      column_ = std::min(columns_ - 1, column_ + n);
      break;
    case 'D':
      column_ -= std::min(column_, n);
      break;
    case 'G':
      column_ = std::min(columns_, n) - 1;
      break;
    case 'J':
      EXPECT_TRUE(!given || number == 0) << "only to the end of the screen";
      for (std::size_t r = row_ + 1; r < lines_.size(); ++r) lines_[r] = {};
      [[fallthrough]];
    case 'K':
      if (lines_[row_].cells.size() > column_) lines_[row_].cells.resize(column_);
      lines_[row_].continues = false;
      break;
    case 'm':
    case 'h':
    case 'l':
      break;
    default:
      ADD_FAILURE() << "CSI " << what << " is not known here";
  }
}

void Terminal::resize(std::size_t columns, std::size_t rows) {
  if (resize_ == Resize::kCuts) {
    for (Row& row : lines_) row.cells.resize(std::min(row.cells.size(), columns));
    column_ = std::min(column_, columns - 1);
  } else {
    std::vector<Row> out;
    std::size_t new_row = 0, new_column = 0;
    for (std::size_t first = 0; first < lines_.size();) {
      std::vector<std::string> line;
      std::size_t last = first, cursor = std::string::npos;
      for (;; ++last) {
        if (last == row_) cursor = line.size() + column_;
        line.insert(line.end(), lines_[last].cells.begin(), lines_[last].cells.end());
        if (!lines_[last].continues || last + 1 == lines_.size()) break;
      }
      const std::size_t begin = out.size();
      std::size_t at = 0;
      do {
        Row& row = out.emplace_back();
        const std::size_t size = std::min(columns, line.size() - at);
        row.cells.assign(line.begin() + static_cast<std::ptrdiff_t>(at),
                         line.begin() + static_cast<std::ptrdiff_t>(at + size));
        at += size;
        row.continues = at < line.size();
      } while (at < line.size());
      if (cursor != std::string::npos) {
        new_row = std::min(out.size() - 1, begin + cursor / columns);
        new_column = cursor - (new_row - begin) * columns;
      }
      first = last + 1;
    }
    lines_ = std::move(out);
    row_ = new_row;
    column_ = std::min(new_column, columns);
  }
  columns_ = columns;
  rows_ = rows;
}

std::string Terminal::text_of(const Row& row) {
  std::string text;
  for (const std::string& cell : row.cells) text += cell;
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

std::vector<std::string> Terminal::from(std::size_t first) const {
  std::vector<std::string> out;
  for (std::size_t r = first; r < lines_.size(); ++r) out.push_back(text_of(lines_[r]));
  while (!out.empty() && out.back().empty()) out.pop_back();
  return out;
}

std::vector<std::string> Terminal::screen() const { return from(top()); }
std::vector<std::string> Terminal::all() const { return from(0); }

std::string flat(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows)
    for (const char c : row + " ")
      if (c != ' ' || (!text.empty() && text.back() != ' ')) text += c;
  return text;
}

TerminalProcess::TerminalProcess(std::vector<std::string> command, std::size_t columns, std::size_t rows,
                                 Terminal::Resize resize)
    : terminal_(columns, rows, resize) {
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  winsize size{static_cast<unsigned short>(rows), static_cast<unsigned short>(columns), 0, 0};
  int master = -1;
  pid_ = forkpty(&master, nullptr, nullptr, &size);
  if (pid_ == 0) {
    setenv("TERM", "xterm-256color", 1);
    execv(argv[0], argv.data());
    _exit(127);
  }
  EXPECT_GT(pid_, 0);
  master_ = io::Fd{master};
  fcntl(master, F_SETFD, FD_CLOEXEC);
}

TerminalProcess::~TerminalProcess() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

bool TerminalProcess::read_some(std::chrono::milliseconds slice) {
  pollfd file{master_.get(), POLLIN, 0};
  if (poll(&file, 1, static_cast<int>(slice.count())) <= 0) return true;
  std::array<char, 4096> bytes;
  const ssize_t size = ::read(master_.get(), bytes.data(), bytes.size());
  if (size <= 0) return false;
  terminal_.feed({bytes.data(), static_cast<std::size_t>(size)});
  return true;
}

bool TerminalProcess::wait_until(const std::function<bool(const Terminal&)>& wanted,
                                 std::chrono::milliseconds timeout) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  while (!wanted(terminal_)) {
    if (std::chrono::steady_clock::now() > until) return false;
    if (!read_some(50ms)) return wanted(terminal_);
  }
  return true;
}

bool TerminalProcess::wait_for(std::string_view text) {
  return wait_until([&](const Terminal& t) { return flat(t.all()).find(text) != std::string::npos; });
}

void TerminalProcess::watch(std::chrono::milliseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < until && read_some(20ms)) {
  }
}

void TerminalProcess::resize(std::size_t columns, std::size_t rows) {
  watch(1ms);  // output already sent still gets the old size
  terminal_.resize(columns, rows);
  const winsize size{static_cast<unsigned short>(rows), static_cast<unsigned short>(columns), 0, 0};
  EXPECT_EQ(ioctl(master_.get(), TIOCSWINSZ, &size), 0);
}

void TerminalProcess::type(std::string_view keys) const {
  EXPECT_EQ(::write(master_.get(), keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
}

void TerminalProcess::signal(int number) const { ::kill(pid_, number); }

int TerminalProcess::wait() {
  const auto until = std::chrono::steady_clock::now() + 30s;
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > until) {
      ADD_FAILURE() << "it does not end";
      return -1000;
    }
    if (!read_some(20ms)) poll(nullptr, 0, 5);
  }
  pid_ = -1;
  while (true) {
    pollfd file{master_.get(), POLLIN, 0};
    if (poll(&file, 1, 0) <= 0 || !read_some(0ms)) break;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string TerminalProcess::picture() const {
  std::string text = "\n";
  for (const std::string& row : terminal_.all()) text += "  |" + row + "\n";
  return text;
}

}  // namespace tandem::test
