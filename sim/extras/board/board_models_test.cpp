// SPDX-License-Identifier: Apache-2.0
// The models around the board: each must detect the faults that it is there for.
#include "sim/extras/board/board_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "golden/board_pixel.hpp"
#include "sim/extras/board/board_picture.hpp"
#include "sim/extras/board/spi_host.hpp"
#include "sim/os/must.hpp"

namespace halfway::board {
namespace {

/// The error of a model; empty if there is none.
template <class Work>
std::string fault_of(const Work& work) {
  const auto end = caught([&] {
    work();
    return 0;
  });
  return end ? "" : end.error().message;
}

/// Drives a monitor like a board with these timings, and colours that depend on the place.
std::vector<DotPicture> pictures_of(const VideoTiming& line, const VideoTiming& field,
                                    bool colour_in_blank = false) {
  std::vector<DotPicture> pictures;
  Monitor monitor([&](const DotPicture& dots) { pictures.push_back(dots); });
  for (int frame = 0; frame < 3; ++frame)
    for (int y = 0; y < field.total(); ++y)
      for (int x = 0; x < line.total(); ++x) {
        const auto in_sync = [](int at, const VideoTiming& t) {
          return at >= t.visible + t.front_porch && at < t.visible + t.front_porch + t.sync;
        };
        VideoPins pins{.hsync = !in_sync(x, line), .vsync = !in_sync(y, field)};
        if ((x < line.visible && y < field.visible) || (colour_in_blank && x == line.visible && y == 7))
          pins.red = static_cast<std::uint8_t>(1 + (x + 3 * y) % 7);
        for (int i = 0; i < c_clocks_per_dot; ++i) monitor.clock(pins);
      }
  return pictures;
}

TEST(Monitor, DecodesEachDot) {
  const std::vector<DotPicture> pictures = pictures_of(c_line, c_field);
  ASSERT_EQ(pictures.size(), 2u);
  for (std::size_t y : {0u, 1u, 479u})
    for (std::size_t x : {0u, 1u, 639u}) EXPECT_EQ(pictures[0][y * 640 + x][0], 1 + (x + 3 * y) % 7);
  EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(Monitor, FindsWrongTimings) {
  const auto finds = [](const char* fault, const VideoTiming& line, const VideoTiming& field,
                        bool colour_in_blank = false) {
    EXPECT_NE(fault_of([&] { pictures_of(line, field, colour_in_blank); }).find(fault), std::string::npos)
        << fault;
  };
  finds("a line of 1602 clocks", {640, 16, 96, 49}, c_field);
  finds("a horizontal sync of 190 clocks", {640, 16, 95, 49}, c_field);
  finds("a vertical sync", c_line, {480, 9, 3, 33});
  finds("a vertical sync after 524 lines", c_line, {480, 11, 2, 33});
  finds("outside", {640, 17, 96, 47}, c_field);
  finds("outside", c_line, {480, 11, 2, 32});
  finds("outside", c_line, c_field, true);
}

BoardOutputs access(bool read, bool write, std::uint32_t address, std::uint16_t data = 0) {
  BoardOutputs pins{};
  pins.sram_read = read;
  pins.sram_write = pins.sram_data_enable = write;
  pins.sram_address = address;
  pins.sram_data_out = data;
  return pins;
}

TEST(SramModel, ReadsWhatWasWritten) {
  SramModel sram(100);
  sram.clock(access(false, true, 99, 0x1234));
  sram.clock(access(false, true, 0, 0x4321));
  EXPECT_EQ(sram.clock(access(true, false, 99)), 0x1234);
  EXPECT_EQ(sram.clock(access(true, false, 0)), 0x4321);
}

TEST(SramModel, FindsFaultsOfTheBus) {
  const auto fault = [](const std::vector<BoardOutputs>& clocks) {
    return fault_of([&] {
      SramModel sram(100);
      for (const BoardOutputs& pins : clocks) sram.clock(pins);
    });
  };
  EXPECT_EQ(fault({access(true, false, 1), access(false, false, 0), access(false, true, 1)}), "");
  EXPECT_EQ(fault({access(true, false, 1), access(false, true, 1)}),
            "SRAM: write in the clock after a read: the bus is not released in clock 2");
  EXPECT_EQ(fault({access(true, true, 1)}), "SRAM: read and write in clock 1");
  EXPECT_EQ(fault({access(false, true, 100)}), "SRAM: address 100 of 100 words in clock 1");
  BoardOutputs undriven = access(false, true, 1);
  undriven.sram_data_enable = 0;
  EXPECT_EQ(fault({undriven}),
            "SRAM: the FPGA drives the data, but does not write, or the reverse in clock 1");
}

TEST(BoardPicture, KeepsTheFirstOfEqualDepths) {
  BoardPicture picture(0x1234);
  const Fragment fragments[] = {{0, 0x000200, 0, 1, 255, 0, 0},
                                {0, 0x0002ff, 0, 1, 0, 255, 0},
                                {0, 0x0001ff, 1, 0, 0, 0, 255},
                                {0, 0xffff00, 2, 2, 255, 255, 255}};
  picture.add(fragments);
  EXPECT_EQ(picture.colours()[0], 0x1234);
  EXPECT_EQ(picture.colours()[1], 0xf800);
  EXPECT_EQ(picture.colours()[320], 0x001f);
  // The farthest depth is never drawn.
  EXPECT_EQ(picture.colours()[642], 0x1234);
  EXPECT_EQ(picture.dots()[2][0], 7);
}

TEST(BoardPixel, IsInsideTheFrame) {
  const auto place = [](std::uint16_t y, std::uint16_t x) {
    return golden::board_place({.triangle = 0, .z = 0, .y = y, .x = x, .red = 0, .green = 0, .blue = 0});
  };
  EXPECT_EQ(place(239, 319), 76799u);
  EXPECT_EQ(place(240, 0), std::nullopt);
  EXPECT_EQ(place(0, 320), std::nullopt);
}

TEST(SpiPacket, HasTheCheckValueOfTheCrc) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc16(std::vector<std::uint8_t>(digits.begin(), digits.end())), 0x29b1);
}

TEST(SpiPacket, SendsTheHighestBitsFirst) {
  const std::vector<std::uint32_t> words = {0x44332211, 0x1};
  const std::vector<std::uint8_t> packet = draw_packet(words, 33);
  ASSERT_EQ(packet.size(), 1u + 5 + 2);
  EXPECT_EQ(std::vector<std::uint8_t>(packet.begin(), packet.end() - 2),
            (std::vector<std::uint8_t>{c_draw, 0x01, 0x44, 0x33, 0x22, 0x11}));
  // The CRC of a message and its CRC is 0.
  EXPECT_EQ(crc16(packet), 0);
}

/// A device that answers with a status byte, and keeps the bits of each packet.
struct Device {
  std::uint8_t status = c_room;
  std::vector<std::vector<bool>> packets;
  int shortest_high = 1000, shortest_low = 1000;

  void run(SpiHost& host) {
    SpiPins last;
    bool answer = false;
    int since = 1000;
    while (!host.done()) {
      const SpiPins pins = host.clock(answer);
      if (last.select_n && !pins.select_n) packets.emplace_back();
      if (pins.select_n == last.select_n && pins.clock != last.clock) {
        int& shortest = pins.clock ? shortest_low : shortest_high;
        shortest = std::min(shortest, since);
        since = 0;
      }
      ++since;
      if (!last.clock && pins.clock) packets.back().push_back(pins.data);
      const std::size_t bit = packets.empty() ? 0 : packets.back().size();
      answer = bit < 8 && (status >> (7 - bit) & 1) != 0;
      last = pins;
    }
  }
};

TEST(SpiHost, SendsItsScriptWhenThereIsRoom) {
  const std::vector<std::uint8_t> packet = draw_packet(std::vector<std::uint32_t>{0xa5}, 8);
  SpiHost host({whole_packet(packet), {HostAction::Kind::packet, packet, 13, 50}, {HostAction::Kind::wait}},
               0);
  Device device{.status = c_room | c_error | 5};
  device.run(host);
  // Poll, packet, poll, part, poll.
  ASSERT_EQ(device.packets.size(), 5u);
  EXPECT_EQ(device.packets[0].size(), 8u);
  ASSERT_EQ(device.packets[1].size(), 8 * packet.size());
  for (std::size_t i = 0; i < device.packets[1].size(); ++i)
    EXPECT_EQ(device.packets[1][i], (packet[i / 8] >> (7 - i % 8) & 1) != 0) << i;
  EXPECT_EQ(device.packets[3].size(), 13u);
  EXPECT_EQ(device.shortest_high, 2);
  EXPECT_EQ(device.shortest_low, 2);
  const HostReport& report = host.report();
  EXPECT_EQ((std::vector<std::uint64_t>{report.packets, report.status_bytes, report.errors, report.faults,
                                        report.frames}),
            (std::vector<std::uint64_t>{5, 5, 5, 0, 5}));
}

TEST(SpiHost, WaitsWhileThereIsNoRoom) {
  SpiHost host({whole_packet(draw_packet(std::vector<std::uint32_t>{1}, 8))}, 0);
  for (int i = 0; i < 10000; ++i) EXPECT_FALSE(host.clock(false).select_n && host.done());
  EXPECT_FALSE(host.done());
  EXPECT_GT(host.report().packets, 50u);
}

}  // namespace
}  // namespace halfway::board
