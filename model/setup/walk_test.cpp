// SPDX-License-Identifier: Apache-2.0
// Compares the golden triangle walker, with the words of plan_walks, with for_each_span, line by line and
// pixel by pixel.
#include "setup/walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <vector>

#include "golden/triangle_walker.hpp"
#include "setup/test/random_triangles.hpp"

namespace halfway {
namespace {

using words::Exact;

struct LineSpan {
  std::int64_t y, begin, end;
  friend bool operator==(const LineSpan&, const LineSpan&) = default;
  friend std::ostream& operator<<(std::ostream& out, const LineSpan& s) {
    return out << "line " << s.y << " [" << s.begin << ", " << s.end << ')';
  }
};

std::vector<LineSpan> expected_spans(const Points& points, int unit_bits, FrameSize frame) {
  std::vector<LineSpan> spans;
  for_each_span(points, unit_bits, frame, [&](std::uint32_t y, std::uint32_t begin, std::uint32_t end) {
    spans.push_back({y, begin, end});
  });
  return spans;
}

// The spans of one walk as the hardware draws them. Its first and last line cover a pixel.
void append_walk(const Walk& walk, std::vector<LineSpan>& spans) {
  golden::TriangleWalker<Exact> walker;
  walker.line_load(header_of(walk));
  EXPECT_FALSE(walker.line_empty()) << "first line";
  for (;;) {
    const std::int64_t start = walker.start().value(), stop = walker.stop().value();
    if (!walker.line_empty())
      spans.push_back(walker.backward() ? LineSpan{walker.y(), stop + 1, start + 1}
                                        : LineSpan{walker.y(), start, stop});
    if (walker.line_last()) break;
    walker.line_step();
  }
  EXPECT_FALSE(walker.line_empty()) << "last line";
}

struct Seen {
  std::map<std::size_t, int> walks;  // triangles by their number of walks
  int backward = 0, upper_and_lower = 0;
};

void expect_walks(const Points& p, int unit_bits, FrameSize frame, Seen& seen) {
  SCOPED_TRACE(::testing::Message() << '(' << p[0].x << ',' << p[0].y << ") (" << p[1].x << ',' << p[1].y
                                    << ") (" << p[2].x << ',' << p[2].y << ") unit_bits " << unit_bits
                                    << " frame " << frame.width << 'x' << frame.height);
  const Walks walks = plan_walks(p, unit_bits, frame);
  std::vector<LineSpan> drawn;
  for (const Walk& walk : walks) {
    EXPECT_GE(walk.upper_lines, 1);
    EXPECT_GE(walk.lower_lines, 0);
    append_walk(walk, drawn);
    seen.backward += walk.backward;
    seen.upper_and_lower += walk.lower_lines > 0;
  }
  EXPECT_LE(walks.size(), 3u);
  EXPECT_EQ(drawn, expected_spans(p, unit_bits, frame));
  ++seen.walks[walks.size()];
}

constexpr std::array<FrameSize, 9> c_walk_frames = {
    {{1, 1}, {1, 4096}, {4096, 1}, {7, 5}, {64, 48}, {333, 200}, {640, 480}, {1000, 700}, {4096, 4096}}};

TEST(Walk, TheHardwareDrawsExactlyTheSpansOfEveryKindOfTriangle) {
  Seen seen;
  for (int unit_bits = 4; unit_bits <= 9; ++unit_bits)
    for (const FrameSize frame : c_walk_frames)
      for (const TriangleKind kind : c_triangle_kinds) {
        RandomTriangles random(static_cast<unsigned>(unit_bits * 1000 + static_cast<int>(kind)));
        const int rounds = frame.height > 1000 ? 12 : 40;
        for (int i = 0; i < rounds; ++i) {
          expect_walks(random.next(kind, unit_bits, frame, unit_bits - 4), unit_bits, frame, seen);
          if (::testing::Test::HasFailure()) return;
        }
      }
  // The triangles must contain enough such cases for the test to be meaningful.
  EXPECT_GT(seen.backward, 1000);
  EXPECT_GT(seen.upper_and_lower, 1000);
  for (const std::size_t walks : {0u, 1u, 2u, 3u}) EXPECT_GT(seen.walks[walks], 50) << walks;
}

}  // namespace
}  // namespace halfway
