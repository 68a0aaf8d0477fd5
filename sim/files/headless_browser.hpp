// SPDX-License-Identifier: Apache-2.0
// Headless Chromium, controlled through its DevTools protocol over a pair of sockets: no port, no driver.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sim/os/subprocess.hpp"

namespace halfway {

/// For tests: failures are exceptions.
class HeadlessBrowser {
 public:
  using Json = nlohmann::json;

  /// Path of the browser; empty if PATH has none.
  static std::string program() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
      if (!find_program(name).empty()) return name;
    return {};
  }

  explicit HeadlessBrowser(const std::filesystem::path& scratch) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw std::runtime_error("socketpair failed");
    const timeval longest{.tv_sec = c_longest.count()};
    setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    const std::string name = program(), profile = "--user-data-dir=" + (scratch / "profile").string(),
                      log = scratch / "browser.log";
    process_ = fork();
    if (process_ == 0) {
      setpgid(0, 0);
      // descriptors 3 and 4 are overwritten in the child, so move the ends above them
      const int end = fcntl(ends[1], F_DUPFD, 10);
      dup2(::open(log.c_str(), O_WRONLY | O_CREAT, 0644), 2);
      dup2(end, 3);
      dup2(end, 4);
      execlp(name.c_str(), name.c_str(), "--headless", "--no-sandbox", "--disable-gpu",
             "--disable-dev-shm-usage", "--disable-background-networking", "--disable-component-update",
             "--no-first-run", profile.c_str(), "--remote-debugging-pipe", "about:blank", nullptr);
      _exit(127);
    }
    close(ends[1]);
    stream_ = fdopen(ends[0], "r");
    const Json target = send("Target.createTarget", {{"url", "about:blank"}});
    session_ =
        send("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
    for (const char* domain : {"Page", "Runtime", "Log", "Network"}) send(std::string(domain) + ".enable");
  }
  ~HeadlessBrowser() {
    std::fclose(stream_);
    if (process_ > 0) {
      kill(-process_, SIGKILL);  // its process group: the browser and its children
      waitpid(process_, nullptr, 0);
    }
  }
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// Send a command and return its result.
  Json send(const std::string& method, Json params = Json::object()) {
    Json command = {{"id", ++last_}, {"method", method}, {"params", std::move(params)}};
    if (!session_.empty()) command["sessionId"] = session_;
    const std::string text = command.dump() + '\0';
    if (::send(fileno(stream_), text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("the browser does not listen");
    for (;;) {
      Json message = receive();
      if (message.value("id", 0) != last_) {
        note(message);
        continue;
      }
      if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
      return message["result"];
    }
  }

  /// The value of an expression. For a promise: the value it resolves to.
  Json evaluate(const std::string& expression) {
    const Json result = send("Runtime.evaluate",
                             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (result.contains("exceptionDetails"))
      throw std::runtime_error(expression + ": " + result["exceptionDetails"].dump());
    return result["result"].value("value", Json());
  }
  /// Wait until an expression is true, for minutes if the machine is slow.
  bool becomes_true(const std::string& expression) {
    const auto end = std::chrono::steady_clock::now() + c_longest;
    while (std::chrono::steady_clock::now() < end) {
      if (evaluate("Boolean(" + expression + ")") == true) return true;
      usleep(50'000);
    }
    return false;
  }

  void open(const std::filesystem::path& page) {
    send("Page.navigate", {{"url", "file://" + page.string()}});
    if (!becomes_true("location.protocol === 'file:' && document.readyState === 'complete'"))
      throw std::runtime_error("the page does not load");
  }
  void resize(int width, int height) {
    send("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  }
  void prefer(const std::string& scheme) {
    send("Emulation.setEmulatedMedia",
         {{"features", {{{"name", "prefers-color-scheme"}, {"value", scheme}}}}});
  }
  void mouse(const std::string& type, double x, double y) {
    send("Input.dispatchMouseEvent", {{"type", type},
                                      {"x", x},
                                      {"y", y},
                                      {"button", "left"},
                                      {"buttons", type == "mouseReleased" ? 0 : 1},
                                      {"clickCount", 1}});
  }
  void click(double x, double y) {
    mouse("mousePressed", x, y);
    mouse("mouseReleased", x, y);
  }
  void drag(std::pair<double, double> from, std::pair<double, double> to) {
    mouse("mousePressed", from.first, from.second);
    mouse("mouseMoved", (from.first + to.first) / 2, (from.second + to.second) / 2);
    mouse("mouseMoved", to.first, to.second);
    mouse("mouseReleased", to.first, to.second);
  }
  /// Scroll to an element and return its centre in the window. `selector` has no double quotes.
  std::pair<double, double> middle_of(const std::string& selector) {
    const Json box =
        evaluate("(() => { const e = document.querySelector(\"" + selector +
                 "\"); e.scrollIntoView({block: 'center', behavior: 'instant'}); const b = "
                 "e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()");
    return {box[0], box[1]};
  }
  /// Send `touchStart` or `touchMove` with all fingers that are down. Touch emulation is enabled first.
  void touch(const std::string& type, const std::vector<std::pair<double, double>>& fingers) {
    Json points = Json::array();
    for (std::size_t i = 0; i < fingers.size(); ++i)
      points.push_back({{"id", i}, {"x", fingers[i].first}, {"y", fingers[i].second}});
    send("Emulation.setTouchEmulationEnabled", {{"enabled", true}, {"maxTouchPoints", 5}});
    send("Input.dispatchTouchEvent", {{"type", type}, {"touchPoints", points}});
  }
  void press(const std::string& key) {
    Json event = {{"type", "keyDown"}, {"key", key}, {"code", key}};
    if (key.size() == 1) event["text"] = key;
    if (key == "Enter") event.update({{"text", "\r"}, {"windowsVirtualKeyCode", 13}});
    if (key == "Escape") event["windowsVirtualKeyCode"] = 27;
    if (key == "ArrowLeft") event["windowsVirtualKeyCode"] = 37;
    if (key == "ArrowRight") event["windowsVirtualKeyCode"] = 39;
    send("Input.dispatchKeyEvent", event);
    event["type"] = "keyUp";
    event.erase("text");
    send("Input.dispatchKeyEvent", event);
  }

  /// Errors and warnings of the console, and exceptions.
  std::vector<std::string> complaints;
  /// URLs requested, except the page itself and data URIs.
  std::vector<std::string> requests;

 private:
  static constexpr std::chrono::seconds c_longest{3600};  // of any wait, on a slow machine

  Json receive() {
    char* message = nullptr;
    std::size_t room = 0;
    const ssize_t count = getdelim(&message, &room, '\0', stream_);
    const std::unique_ptr<char, decltype(&std::free)> owner(message, std::free);
    if (count <= 0) throw std::runtime_error("the browser does not answer");
    return Json::parse(message);
  }
  void note(const Json& message) {
    const std::string method = message.value("method", "");
    const Json params = message.value("params", Json::object());
    if (method == "Runtime.exceptionThrown") complaints.push_back(params.dump());
    if (method == "Log.entryAdded" && params["entry"]["level"] != "info" &&
        params["entry"]["level"] != "verbose")
      complaints.push_back(params.dump());
    if (method == "Runtime.consoleAPICalled" && (params["type"] == "error" || params["type"] == "warning"))
      complaints.push_back(params.dump());
    if (method == "Network.requestWillBeSent") {
      const std::string url = params["request"]["url"];
      if (!url.starts_with("data:") && params.value("type", "") != "Document") requests.push_back(url);
    }
  }

  pid_t process_ = -1;
  std::FILE* stream_ = nullptr;
  int last_ = 0;
  std::string session_;
};

}  // namespace halfway
