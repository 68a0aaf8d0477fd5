// SPDX-License-Identifier: Apache-2.0
// The memory at the core's port: when it answers, what a read sees, and what it refuses.
#include "sim/extras/core/axi_memory.hpp"

#include <gtest/gtest.h>

#include <array>

#include "sim/os/must.hpp"

namespace halfway::core {
namespace {

constexpr std::uint32_t c_origin = 0x7ff0'0000;
constexpr unsigned c_latency = 5;

class AxiMemoryTest : public testing::Test {
 protected:
  AxiMemoryTest() { memory_.connect(bytes_, c_origin); }

  void clock() { memory_.clock(in_, out_); }
  void address(std::uint32_t at, std::uint8_t length = 0) {
    out_.m_axi_arvalid = 1;
    out_.m_axi_araddr = at;
    out_.m_axi_arlen = length;
    clock();
    out_.m_axi_arvalid = 0;
  }
  /// Writes the words of a burst with all strobes.
  void write(std::uint32_t at, int words) {
    out_.m_axi_awvalid = 1;
    out_.m_axi_awaddr = at;
    out_.m_axi_awlen = static_cast<std::uint8_t>(words - 1);
    out_.m_axi_wvalid = 1;
    out_.m_axi_wdata = 0x11223344;
    out_.m_axi_wstrb = 0xf;
    for (int i = 1; i <= words; ++i) {
      out_.m_axi_wlast = i == words;
      clock();
      out_.m_axi_awvalid = 0;
    }
    out_.m_axi_wvalid = 0;
  }
  int clocks_until(const std::uint8_t& valid) {
    int count = 1;
    for (; valid == 0 && count < 100; ++count) clock();
    return count;
  }

  std::array<std::uint8_t, 64> bytes_{};
  AxiMemory memory_{4, {.latency = c_latency}};
  CoreInputs in_{.m_axi_arready = 1, .m_axi_awready = 1, .m_axi_wready = 1};
  CoreOutputs out_{.m_axi_rready = 1, .m_axi_bready = 1};
};

TEST_F(AxiMemoryTest, AReadSeesTheMemoryAtItsAddressAndAWriteWaitsForItsResponse) {
  write(c_origin + 4, 2);
  address(c_origin + 8);
  EXPECT_EQ(bytes_[8], 0);
  EXPECT_EQ(clocks_until(in_.m_axi_bvalid), c_latency - 1);
  EXPECT_EQ(bytes_[4], 0x44);
  EXPECT_EQ(bytes_[8], 0x44);
  EXPECT_EQ(bytes_[12], 0);
  EXPECT_EQ(clocks_until(in_.m_axi_rvalid), 2);
  EXPECT_EQ(in_.m_axi_rdata, 0U);
  address(c_origin + 4, 1);
  EXPECT_EQ(clocks_until(in_.m_axi_rvalid), c_latency);
  EXPECT_EQ(in_.m_axi_rdata, 0x11223344U);
  EXPECT_EQ(in_.m_axi_rlast, 0);
  clock();
  EXPECT_EQ(in_.m_axi_rlast, 1);
  EXPECT_EQ(memory_.words_read(), 3U);
  EXPECT_EQ(memory_.words_written(), 2U);
}

TEST_F(AxiMemoryTest, RefusesWhatItDoesNotHave) {
  memory_.refuse(c_origin + 8, 4);
  for (const auto& [at, response] : {std::pair(c_origin - 4, 2),
                                     {c_origin, 0},
                                     {c_origin + 8, 2},
                                     {c_origin + 12, 0},
                                     {c_origin + 64, 2}}) {
    address(at);
    clocks_until(in_.m_axi_rvalid);
    EXPECT_EQ(in_.m_axi_rresp, response) << at;
    write(at, 1);
    clocks_until(in_.m_axi_bvalid);
    EXPECT_EQ(in_.m_axi_bresp, response) << at;
    clock();
  }
  EXPECT_EQ(bytes_[8], 0);
  EXPECT_EQ(bytes_[12], 0x44);
}

TEST_F(AxiMemoryTest, FindsBurstsThatAxiDoesNotAllow) {
  EXPECT_THROW(address(c_origin + 2), Failure);
  EXPECT_THROW(address(c_origin + 4092, 1), Failure);
  out_.m_axi_arvalid = 0;
  // The last word is marked one word too early.
  out_.m_axi_awvalid = out_.m_axi_wvalid = out_.m_axi_wlast = 1;
  out_.m_axi_awaddr = c_origin;
  out_.m_axi_awlen = 1;
  clock();
  out_.m_axi_awvalid = out_.m_axi_wlast = 0;
  clock();
  out_.m_axi_wvalid = 0;
  EXPECT_THROW(clocks_until(in_.m_axi_bvalid), Failure);
}

TEST(AxiMemory, FindsTransfersThatChangeWhileTheyWait) {
  // The memory is not ready in the first clock; a signal changes in the second.
  const auto finds = [](auto CoreOutputs::* valid, auto CoreOutputs::* signal, std::uint8_t value) {
    AxiMemory memory(4, {});
    CoreInputs in{};
    CoreOutputs out{};
    out.*valid = 1;
    memory.clock(in, out);
    out.*signal = value;
    EXPECT_THROW(memory.clock(in, out), Failure);
  };
  using Out = CoreOutputs;
  finds(&Out::m_axi_arvalid, &Out::m_axi_arvalid, 0);
  finds(&Out::m_axi_arvalid, &Out::m_axi_araddr, 4);
  finds(&Out::m_axi_arvalid, &Out::m_axi_arlen, 4);
  finds(&Out::m_axi_awvalid, &Out::m_axi_awvalid, 0);
  finds(&Out::m_axi_awvalid, &Out::m_axi_awaddr, 4);
  finds(&Out::m_axi_awvalid, &Out::m_axi_awlen, 4);
  finds(&Out::m_axi_wvalid, &Out::m_axi_wvalid, 0);
  finds(&Out::m_axi_wvalid, &Out::m_axi_wdata, 4);
  finds(&Out::m_axi_wvalid, &Out::m_axi_wstrb, 4);
  finds(&Out::m_axi_wvalid, &Out::m_axi_wlast, 1);
}

}  // namespace
}  // namespace halfway::core
