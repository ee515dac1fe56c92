// A texture that several processes make together.
#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <list>
#include <thread>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class OneJob : public Workspace {
 protected:
  OneJob() { write_config("giant.toml", "", 3); }

  void write_config(const std::string& name, const std::string& more, int iterations) const {
    write_text(folder_ / name,
               fmt::format("size = [48, 200]\ntile = 'both'\n"
                           "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                           "[[method]]\nname = 'g'\nkind = 'neural'\npreset = 'gatys'\n"
                           "network = 'multiscale_1'\noptimizer = ['adam']\npositions = 4096\n"
                           "iterations = [{}]\n{}",
                           iterations, more));
  }

  // The others of `count` processes meet the first by a file, or at an address.
  std::vector<std::string> words(const std::string& config, int process, int count,
                                 const std::string& output,
                                 const std::string& meeting = "meeting") const {
    return {
        "run",    config,  "--output",  output, "--one-job", fmt::format("{}/{}", process, count),
        "--meet", meeting, "--threads", "1"};
  }

  // Two processes that meet there make the texture that one makes.
  void expect_that_of_one_process(const std::string& meeting) const {
    ASSERT_EQ(run({"run", "giant.toml", "--output", "one"}).exit_code, 0);
    Process second(folder_, words("giant.toml", 2, 2, "two", meeting));
    const Outcome first = run(words("giant.toml", 1, 2, "two", meeting));
    const Outcome other = second.wait();
    ASSERT_EQ(first.exit_code, 0) << first.errors << other.errors;
    EXPECT_EQ(other.exit_code, 0) << other.errors;
    EXPECT_EQ(other.errors, "");
    const Image alone = read_image(folder_ / "one" / picture_).image,
                shared = read_image(folder_ / "two" / picture_).image;
    ASSERT_EQ(alone.size(), shared.size());
    for (std::size_t i = 0; i < alone.pixels.size(); ++i)
      ASSERT_NEAR(alone.pixels[i], shared.pixels[i], 1.01 / 255) << i;  // as rounding falls
    EXPECT_EQ(read_image(folder_ / "one" / picture_).metadata,
              read_image(folder_ / "two" / picture_).metadata);
    EXPECT_EQ(record("e/g/seed1", "two")->status, Status::done);
    EXPECT_TRUE(fs::exists(folder_ / "two/index.html"));
  }

  const std::string picture_ = "e/g/seed1.png";
};

// A port that nobody listens at: the system names one, and gives it to the next who asks for it.
int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  auto* const plain = reinterpret_cast<sockaddr*>(&address);
  EXPECT_EQ(bind(socket, plain, length), 0);
  EXPECT_EQ(getsockname(socket, plain, &length), 0);
  close(socket);
  return ntohs(address.sin_port);
}

TEST_F(OneJob, ItsTextureIsThatOfOneProcess) { expect_that_of_one_process("meeting"); }

TEST_F(OneJob, TheyMeetAtAnAddress) {
  expect_that_of_one_process(fmt::format("127.0.0.1:{}", free_port()));
}

TEST_F(OneJob, TheOthersEndWhenOneDies) {
  write_config("long.toml", "", 100000);
  Process second(folder_, words("long.toml", 2, 2, "two"));
  Process first(folder_, words("long.toml", 1, 2, "two"));
  for (int i = 0; i < 6000 && !fs::exists(folder_ / "two/e/g/seed1.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  second.signal(SIGKILL);
  const Outcome outcome = first.wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_THAT(outcome.errors, testing::HasSubstr("another of the 2 processes is gone"));
  EXPECT_EQ(record("e/g/seed1", "two")->status, Status::failed);
}

TEST_F(OneJob, RefusesWhatCannotBeDoneTogether) {
  const auto refused = [&](const std::string& message, const std::string& more) {
    write_config("refused.toml", more, 3);
    expect_refused("run", {"refused.toml", "--one-job", "1/2"}, message);
  };
  refused("spectrum_weight cannot be honoured", "spectrum_weight = 1\n");
  refused("match_histogram cannot be honoured", "match_histogram = true\n");
  refused("[preview] cannot be honoured", "[preview]\n");
  refused("method 'q' of kind 'quilting'", "[[method]]\nname = 'q'\nkind = 'quilting'\n");
  expect_refused("run", {"giant.toml", "--one-job", "1/8"}, "too small to be shared");
  expect_refused("run", {"giant.toml", "--one-job"}, "--one-job 1/2");
  expect_refused("run", {"giant.toml", "--one-job", "3/2"}, "'3/2' is no process");
  expect_refused("run", {"giant.toml", "--one-job", "1/2", "--jobs", "2"}, "not with --shard");
  expect_refused("run", {"giant.toml", "--meet", "x:1"}, "--meet goes with --one-job");
}

TEST_F(OneJob, ProcessesOfDifferentConfigsAreRefused) {
  write_config("other.toml", "", 4);
  Process second(folder_, words("other.toml", 2, 2, "two"));
  const Outcome first = run(words("giant.toml", 1, 2, "two"));
  const Outcome other = second.wait();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_EQ(other.exit_code, 1);
  for (const Outcome& outcome : {first, other})
    EXPECT_THAT(outcome.errors, testing::HasSubstr("were to make different textures"));
}

}  // namespace
}  // namespace gramloom
