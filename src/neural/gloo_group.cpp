#include "neural/gloo_group.h"

#include <ATen/ATen.h>
#include <netdb.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string>
#include <torch/csrc/distributed/c10d/FileStore.hpp>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>

#include "io/text_file.h"

namespace gramloom::neural {

namespace {

using Store = c10::intrusive_ptr<c10d::Store>;

// What `work` returns; what goes wrong between processes, whoever noticed, is GroupLost.
template <class Work>
auto among_processes(int size, Work&& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    throw GroupLost("another of the {} processes is gone or does not answer: {}", size,
                    first_line(error.what()));
  }
}

bool has_address(const std::string& host) {
  addrinfo* found = nullptr;
  const bool has = getaddrinfo(host.c_str(), nullptr, nullptr, &found) == 0;
  if (found) freeaddrinfo(found);
  return has;
}

// Where this machine listens: at the address of its name, or of the interface that the environment
// names. One whose name has no address can only meet processes of its own: Gloo would say so on
// standard error, whatever the user does with it.
auto device() {
  if (const char* interface = std::getenv("GLOO_SOCKET_IFNAME"); interface && *interface)
    return c10d::ProcessGroupGloo::createDeviceForInterface(interface);
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return has_address(name.data()) ? c10d::ProcessGroupGloo::createDefaultDevice()
                                  : c10d::ProcessGroupGloo::createDeviceForHostname("127.0.0.1");
}

class GlooGroup : public Group {
 public:
  GlooGroup(const Store& store, const GroupPlace& place)
      : Group(place.rank, place.size), store_(store), patience_(place.patience) {
    among_processes(size(), [&] {
      const auto options = c10d::ProcessGroupGloo::Options::create(patience_);
      options->devices.push_back(device());
      options->threads = 1;  // one at a time: so they need not be told apart
      gloo_ = c10::make_intrusive<c10d::ProcessGroupGloo>(store, rank(), size(), options);
      return 0;
    });
  }

  void exchange(const std::vector<Parcel>& out, const std::vector<Parcel>& in) const override {
    among_processes(size(), [&] {
      std::vector<c10::intrusive_ptr<Work>> works;
      std::vector<std::vector<at::Tensor>> tensors;  // must live until all have ended
      const auto begin = [&](const Parcel& parcel, auto&& how) {
        if (parcel.bytes.empty()) return;
        tensors.push_back({at::from_blob(
            parcel.bytes.data(), {static_cast<std::int64_t>(parcel.bytes.size())}, at::kByte)});
        works.push_back(how(tensors.back(), parcel.peer));
      };
      for (const Parcel& parcel : in)
        begin(parcel, [&](auto& tensor, int peer) { return gloo_->recv(tensor, peer, 0); });
      for (const Parcel& parcel : out) {
        begin(parcel, [&](auto& tensor, int peer) { return gloo_->send(tensor, peer, 0); });
        bytes_sent_ += std::ssize(parcel.bytes);
      }
      for (const auto& work : works) work->wait(patience_);
      return 0;
    });
  }

 protected:
  void reduce(void* values, std::size_t count, Number number, bool largest) const override {
    const at::ScalarType type = number == Number::float32   ? at::kFloat
                                : number == Number::float64 ? at::kDouble
                                                            : at::kInt;
    among_processes(size(), [&] {
      std::vector<at::Tensor> tensors{
          at::from_blob(values, {static_cast<std::int64_t>(count)}, type)};
      c10d::AllreduceOptions options;
      options.reduceOp = largest ? c10d::ReduceOp::MAX : c10d::ReduceOp::SUM;
      options.timeout = patience_;
      gloo_->allreduce(tensors, options)->wait(patience_);
      // Around a ring, once to add up and once to spread the sums.
      bytes_sent_ += 2 * static_cast<std::int64_t>(tensors[0].nbytes()) * (size() - 1) / size();
      return 0;
    });
  }

 private:
  using Work = std::decay_t<decltype(*std::declval<c10d::ProcessGroupGloo>().barrier())>;

  Store store_;
  std::chrono::milliseconds patience_;
  c10::intrusive_ptr<c10d::ProcessGroupGloo> gloo_;
};

// The port of "HOST:PORT"; 0: that is none.
std::uint16_t port_of(const std::string& meeting) {
  const std::size_t colon = meeting.rfind(':');
  std::uint16_t port = 0;
  if (colon == std::string::npos || colon == 0) return 0;
  const char *begin = meeting.data() + colon + 1, *end = meeting.data() + meeting.size();
  const auto [stopped, error] = std::from_chars(begin, end, port);
  return error == std::errc() && stopped == end ? port : std::uint16_t{0};
}

// LibTorch 2 would meet by libuv, which Debian 13's was built without; LibTorch 1 knows none.
template <class Options>
void meet_by_plain_sockets(Options& options) {
  if constexpr (requires { options.useLibUV; }) options.useLibUV = false;
}

Store open_store(const GroupPlace& place) {
  const std::uint16_t port = port_of(place.meeting);
  if (port == 0) {
    auto store = c10::make_intrusive<c10d::FileStore>(place.meeting, place.size);
    store->setTimeout(place.patience);
    return store;
  }
  c10d::TCPStoreOptions options;
  options.port = port;
  options.isServer = place.rank == 0;
  options.numWorkers = static_cast<std::size_t>(place.size);
  options.waitWorkers = false;
  options.timeout = place.patience;
  meet_by_plain_sockets(options);
  return c10::make_intrusive<c10d::TCPStore>(place.meeting.substr(0, place.meeting.rfind(':')),
                                             options);
}

}  // namespace

std::shared_ptr<Group> join_group(const GroupPlace& place) {
  try {
    const Store store = open_store(place);
    // The first to come says how many there are: with another number nobody would ever meet.
    const std::string size = fmt::format("{}", place.size);
    if (store->add("came", 1) == 1)
      store->set("size", std::vector<std::uint8_t>(size.begin(), size.end()));
    else if (const auto first = store->get("size"); !std::ranges::equal(first, size))
      throw GroupLost("process {} was told of {} processes, the first at {} of {}", place.rank + 1,
                      size, place.meeting, std::string(first.begin(), first.end()));
    if (store->add(fmt::format("process {}", place.rank), 1) > 1)
      throw GroupLost("there are two processes of rank {} at {}", place.rank, place.meeting);
    return std::make_shared<GlooGroup>(store, place);
  } catch (const GroupLost&) {
    throw;
  } catch (const std::exception& error) {
    throw GroupLost("process {} of {} cannot meet the others at {}: {}", place.rank, place.size,
                    place.meeting, first_line(error.what()));
  }
}

}  // namespace gramloom::neural
