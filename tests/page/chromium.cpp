#include "page/chromium.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr int patience_ms = 300000;  // a busy machine starts a browser slowly

// The browser reads commands from file 3 and answers on file 4.
[[noreturn]] void become(const fs::path& program, const fs::path& profile, int commands,
                         int answers) {
  // Away from 3 and 4 first, so that neither is closed by the other's move.
  const int in = fcntl(commands, F_DUPFD, 10);
  const int out = fcntl(answers, F_DUPFD, 10);
  dup2(in, 3);
  dup2(out, 4);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  setpgid(0, 0);
  const std::string folder = "--user-data-dir=" + profile.string();
  // The sandbox asks for rights that containers and root do not have; the page is our own.
  execl(program.c_str(), program.c_str(), "--headless=new", "--no-sandbox", "--disable-gpu",
        "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
        "--hide-scrollbars",
        // WebGL by software.
        "--use-angle=swiftshader", "--enable-unsafe-swiftshader", folder.c_str(),
        "--remote-debugging-pipe", "about:blank", nullptr);
  _exit(127);
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    static const std::string letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto digit = letters.find(c);
    if (digit == std::string::npos) break;
    value = (value << 6) | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((value >> bits) & 0xff);
  }
  return bytes;
}

// One line for an event that says that something is wrong; "" for others.
std::string problem_in(const Chromium::Json& event) {
  const std::string method = event.value("method", "");
  const auto& params = event.value("params", Chromium::Json::object());
  if (method == "Runtime.exceptionThrown") return params.dump();
  if (method == "Network.loadingFailed") return params.dump();
  if (method == "Log.entryAdded") return params.dump();
  if (method == "Runtime.consoleAPICalled" &&
      (params["type"] == "error" || params["type"] == "warning" || params["type"] == "assert"))
    return params.dump();
  return "";
}

}  // namespace

std::optional<fs::path> Chromium::find() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    for (const auto* name : {"chromium", "chromium-browser", "google-chrome"})
      if (const fs::path program = fs::path(folder) / name; access(program.c_str(), X_OK) == 0)
        return program;
  return std::nullopt;
}

Chromium::Chromium(const fs::path& program)
    : profile_(fs::temp_directory_path() / fmt::format("gramloom_chromium_{}", getpid())) {
  std::array<int, 2> commands{};
  std::array<int, 2> answers{};
  if (pipe2(commands.data(), O_CLOEXEC) != 0 || pipe2(answers.data(), O_CLOEXEC) != 0)
    throw Error("cannot make a pipe");
  pid_ = fork();
  if (pid_ == 0) become(program, profile_, commands[0], answers[1]);
  close(commands[0]);
  close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
  const Json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})
                 .at("sessionId");
  for (const std::string domain : {"Page", "Runtime", "Log", "Network"}) call(domain + ".enable");
  call("Emulation.setFocusEmulationEnabled", {{"enabled", true}});
}

Chromium::~Chromium() {
  close(to_);
  close(from_);
  kill(-pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  // Helpers of the browser may still be writing there while they end.
  std::error_code error;
  for (int i = 0; i < 50; ++i) {
    fs::remove_all(profile_, error);
    if (!error) break;
    usleep(20000);
  }
}

Chromium::Json Chromium::receive() {
  for (;;) {
    if (const auto end = unread_.find('\0'); end != std::string::npos) {
      const Json message = Json::parse(unread_.substr(0, end));
      unread_.erase(0, end + 1);
      return message;
    }
    pollfd ready{from_, POLLIN, 0};
    if (poll(&ready, 1, patience_ms) <= 0) throw Error("the browser does not answer");
    std::array<char, 65536> buffer{};
    const ssize_t size = read(from_, buffer.data(), buffer.size());
    if (size <= 0) throw Error("the browser has gone away");
    unread_.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

Chromium::Json Chromium::call(const std::string& method, const Json& params) {
  Json message{{"id", ++count_}, {"method", method}, {"params", params}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump() + '\0';
  if (write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw Error("the browser does not listen");
  for (;;) {
    Json answer = receive();
    if (!answer.contains("id")) {
      events_.push_back(std::move(answer));
    } else if (answer["id"] == count_) {
      if (answer.contains("error")) throw Error("{}: {}", method, answer["error"].dump());
      return answer["result"];
    }
  }
}

void Chromium::open(const fs::path& file, Size window, bool dark) {
  call("Emulation.setDeviceMetricsOverride", {{"width", window.width},
                                              {"height", window.height},
                                              {"deviceScaleFactor", 1},
                                              {"mobile", window.width < 500}});
  call("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
  // From a blank page, so that an address with another "#" loads anew, too.
  call("Page.navigate", {{"url", "about:blank"}});
  std::string url = "file://";
  for (const char c : file.string())
    url += (c == '%' || c == '#' || c == '?') ? fmt::format("%{:02X}", c) : std::string(1, c);
  const Json went = call("Page.navigate", {{"url", url}});
  if (went.contains("errorText")) throw Error("{}: {}", url, went["errorText"].dump());
  evaluate(
      "new Promise((done) => document.readyState === 'complete' ? done() : "
      "addEventListener('load', done))");
}

Chromium::Json Chromium::evaluate(const std::string& expression) {
  const Json result = call("Runtime.evaluate", {{"expression", expression},
                                                {"returnByValue", true},
                                                {"awaitPromise", true},
                                                {"userGesture", true}});
  if (result.contains("exceptionDetails"))
    throw Error("{}: {}", expression, result["exceptionDetails"].dump());
  return result["result"].value("value", Json());
}

void Chromium::press(const std::string& key) {
  const bool letter = key.size() == 1;
  const bool types = letter || key == "Enter";
  Json event{{"key", key}, {"type", types ? "keyDown" : "rawKeyDown"}};
  if (types) event["text"] = letter ? key : "\r";
  const std::vector<std::pair<std::string, int>> codes{
      {"Escape", 27},     {" ", 32},         {"ArrowLeft", 37}, {"ArrowUp", 38},
      {"ArrowRight", 39}, {"ArrowDown", 40}, {"Enter", 13},     {"Tab", 9}};
  for (const auto& [name, code] : codes)
    if (name == key) event["windowsVirtualKeyCode"] = code;
  call("Input.dispatchKeyEvent", event);
  event["type"] = "keyUp";
  event.erase("text");
  call("Input.dispatchKeyEvent", event);
}

std::vector<std::string> Chromium::problems() {
  evaluate("new Promise((done) => setTimeout(done, 50))");  // late events arrive
  std::vector<std::string> problems;
  for (const Json& event : events_)
    if (const std::string problem = problem_in(event); !problem.empty())
      problems.push_back(problem);
  events_.clear();
  return problems;
}

void Chromium::screenshot(const fs::path& file) {
  write_text(file, from_base64(call("Page.captureScreenshot", {{"format", "png"}}).at("data")));
}

}  // namespace gramloom
