#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "core/progress.h"

namespace gramloom {

/// How progress is shown: not at all, a line now and then, or a bar that is drawn over.
enum class ProgressStyle { quiet, lines, bar };

/// A bar where standard error is a terminal, lines elsewhere.
ProgressStyle progress_style(bool quiet);

/// One line on standard error, whatever becomes of it.
void print_message(const std::string& line);

/// "0:07", "12:34", "1:02:03"
std::string clock_text(double seconds);
/// Decimal, of two places: "0.14 GB".
std::string memory_text(double bytes);

/// Shows how far the jobs are, on standard error.
class ProgressBar {
 public:
  explicit ProgressBar(ProgressStyle style) : style_(style) {}

  /// Job `number` of `count` begins.
  void start(const std::string& job, std::size_t number, std::size_t count);
  void update(const Progress& progress);
  /// Several jobs at once: so many are done, with parts of those at work, whose names follow.
  void show_jobs(double parts, std::size_t done, std::size_t count, const std::string& at_work);
  /// Calls this for each update, too; of several jobs at once with their names, and as steps how
  /// many are done.
  using Listener = std::function<void(const std::string& job, const Progress& progress)>;
  void listen(Listener listener) { listener_ = std::move(listener); }
  /// Gives complaints to this in place of standard error.
  void tell(std::function<void(const std::string&)> teller) { teller_ = std::move(teller); }
  /// A line that stays: how a job went. Not shown when quiet.
  void message(const std::string& line);
  /// A line that stays and is always shown.
  void complaint(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_time(double part) const;
  void show(double part, const std::string& text);
  void clear();

  ProgressStyle style_;
  Listener listener_;
  std::function<void(const std::string&)> teller_;
  std::string job_;  // that was begun last, with its number: "pebbles/quilting/seed1 (2/4)"
  Clock::time_point started_;
  Clock::time_point shown_;
  std::int64_t first_step_ = -1;
  double shown_part_ = 0;
  bool bar_drawn_ = false;
};

}  // namespace gramloom
