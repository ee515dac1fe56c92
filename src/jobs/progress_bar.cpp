#include "jobs/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gramloom {

namespace {

constexpr double bar_interval = 0.1;   // seconds
constexpr double line_interval = 10;   // seconds
constexpr double line_part = 0.1;      // of the work
constexpr double shortest_line = 1;    // seconds between lines of quick work
constexpr std::size_t bar_width = 20;  // letters

// Straight to the terminal or pipe. Nobody may be reading: that must not stop the work.
void put(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

double seconds_since(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

double part_done(const Progress& progress) {
  if (progress.steps <= 0) return 0;
  return std::clamp(static_cast<double>(progress.step) / static_cast<double>(progress.steps), 0.0,
                    1.0);
}

std::string bar(double part) {
  const auto full = static_cast<std::size_t>(std::lround(part * bar_width));
  return fmt::format("[{:-<{}}]", std::string(full, '#'), bar_width);
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::quiet;
  return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::lines;
}

void print_message(const std::string& line) { put(line + "\n"); }

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::clamp(std::ceil(seconds), 0.0, 1e9));
  if (whole >= 3600)
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string memory_text(double bytes) { return fmt::format("{:.2f} GB", bytes / 1e9); }

void ProgressBar::start(const std::string& job, std::size_t number, std::size_t count) {
  job_ = count > 1 ? fmt::format("{} ({}/{})", job, number, count) : job;
  started_ = Clock::now();
  shown_ = style_ == ProgressStyle::bar ? Clock::time_point() : started_;
  first_step_ = -1;
  shown_part_ = 0;
}

// Of a bar often, of lines when enough has happened.
bool ProgressBar::is_time(double part) const {
  const double waited = seconds_since(shown_);
  return style_ == ProgressStyle::bar
             ? waited >= bar_interval
             : waited >= line_interval ||
                   (waited >= shortest_line && part >= shown_part_ + line_part);
}

void ProgressBar::show(double part, const std::string& text) {
  shown_ = Clock::now();
  shown_part_ = part;
  if (style_ == ProgressStyle::lines) {
    put(fmt::format("{}: {}\n", job_, text));
  } else {
    put("\r" + fmt::format("{} {}  {}", bar(part), text, job_).substr(0, terminal_width() - 1) +
        "\033[K");
    bar_drawn_ = true;
  }
}

void ProgressBar::show_jobs(double parts, std::size_t done, std::size_t count,
                            const std::string& at_work) {
  Progress progress;
  progress.step = static_cast<std::int64_t>(done);
  progress.steps = static_cast<std::int64_t>(count);
  if (listener_) listener_(at_work, progress);
  if (style_ == ProgressStyle::quiet || count == 0) return;
  if (job_.empty()) start("run", 1, 1);
  const double part = parts / static_cast<double>(count);
  if (!is_time(part)) return;
  std::string text = fmt::format("{:3.0f}%  {} of {} jobs", part * 100, done, count);
  if (part > 0)
    text += fmt::format("  {} left", clock_text(seconds_since(started_) / part * (1 - part)));
  show(part, text + "  " + at_work);
}

void ProgressBar::update(const Progress& progress) {
  if (listener_) listener_(job_, progress);
  if (style_ == ProgressStyle::quiet) return;
  if (first_step_ < 0) {
    // A job that goes on from a checkpoint begins in the middle.
    first_step_ = progress.step;
    shown_part_ = part_done(progress);
  }
  const double part = part_done(progress);
  if (!is_time(part)) return;

  std::string text = fmt::format("{:3.0f}%  step {}/{}", part * 100, progress.step, progress.steps);
  if (std::isfinite(progress.loss)) text += fmt::format("  loss {:.3e}", progress.loss);
  if (const auto steps = progress.step - first_step_; steps > 0)
    text +=
        fmt::format("  {} left", clock_text(seconds_since(started_) / static_cast<double>(steps) *
                                            static_cast<double>(progress.steps - progress.step)));
  show(part, text);
}

void ProgressBar::clear() {
  if (bar_drawn_) put("\r\033[K");
  bar_drawn_ = false;
}

void ProgressBar::message(const std::string& line) {
  if (style_ != ProgressStyle::quiet) complaint(line);
}

void ProgressBar::complaint(const std::string& line) {
  if (teller_) return teller_(line);
  clear();
  put(line + "\n");
}

}  // namespace gramloom
