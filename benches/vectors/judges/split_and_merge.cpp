// The textbook: split and merge (Pavlidis and Horowitz 1974; Nguyen et al. 2005), as the line extractors of robots have it.
//
// g++ -O3 -march=native -o split_and_merge split_and_merge.cpp && ./split_and_merge < scans.txt
// Each line of the input: first bearing, step (rad), then ranges in m. Prints the median time of a scan in µs and, for each
// scan, its segments, in the same order.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

struct P { double x, y, r, b; };
struct Line { double a, b, c; };  // a·x + b·y = c, (a, b) a unit vector
struct Seg { P from, to; };

static const double SPLIT = 0.05, GAP = 0.5, FEWEST = 3, MERGE_ANGLE = 0.1, MERGE_OFF = 0.05, FARTHEST = 50.0;

static Line fit(const std::vector<P>& p, size_t from, size_t to) {
    double n = to - from, mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (size_t k = from; k < to; k++) { mx += p[k].x; my += p[k].y; }
    mx /= n; my /= n;
    for (size_t k = from; k < to; k++) {
        double dx = p[k].x - mx, dy = p[k].y - my;
        xx += dx * dx; yy += dy * dy; xy += dx * dy;
    }
    double t = 0.5 * std::atan2(-2 * xy, yy - xx);
    Line l{std::cos(t), std::sin(t), 0};
    l.c = l.a * mx + l.b * my;
    return l;
}

static void split(const std::vector<P>& p, size_t from, size_t to, std::vector<std::pair<size_t, size_t>>& out) {
    if (to - from < FEWEST) return;
    Line l = fit(p, from, to);
    double most = 0;
    size_t at = from;
    for (size_t k = from + 1; k + 1 < to; k++) {
        double d = std::fabs(l.a * p[k].x + l.b * p[k].y - l.c);
        if (d > most) { most = d; at = k; }
    }
    if (most > SPLIT && at > from) {
        split(p, from, at + 1, out);
        split(p, at, to, out);
    } else {
        out.push_back({from, to});
    }
}

static P foot(const Line& l, const P& p) {
    double d = l.a * p.x + l.b * p.y - l.c;
    return {p.x - d * l.a, p.y - d * l.b, 0, 0};
}

static void extract(double first, double step, const std::vector<double>& ranges, std::vector<Seg>& segs) {
    static std::vector<P> p;
    static std::vector<std::pair<size_t, size_t>> runs, kept;
    p.clear(); runs.clear(); kept.clear(); segs.clear();
    for (size_t k = 0; k < ranges.size(); k++) {
        double r = ranges[k], b = first + step * k;
        if (r > 0.01 && r < FARTHEST) p.push_back({r * std::cos(b), r * std::sin(b), r, b});
    }
    size_t from = 0;
    for (size_t k = 1; k <= p.size(); k++) {
        if (k == p.size() || std::hypot(p[k].x - p[k - 1].x, p[k].y - p[k - 1].y) > GAP) {
            split(p, from, k, runs);
            from = k;
        }
    }
    for (auto& run : runs) {
        if (!kept.empty()) {
            auto& last = kept.back();
            Line a = fit(p, last.first, last.second), b = fit(p, run.first, run.second);
            double turn = std::fabs(std::asin(std::clamp(a.a * b.b - a.b * b.a, -1.0, 1.0)));
            double gap = std::hypot(p[run.first].x - p[last.second - 1].x, p[run.first].y - p[last.second - 1].y);
            if (turn < MERGE_ANGLE && gap < GAP) {
                Line both = fit(p, last.first, run.second);
                double most = 0;
                for (size_t k = last.first; k < run.second; k++)
                    most = std::max(most, std::fabs(both.a * p[k].x + both.b * p[k].y - both.c));
                if (most < MERGE_OFF) { last.second = run.second; continue; }
            }
        }
        kept.push_back(run);
    }
    for (auto& run : kept) {
        Line l = fit(p, run.first, run.second);
        segs.push_back({foot(l, p[run.first]), foot(l, p[run.second - 1])});
    }
}

int main() {
    std::string line;
    std::vector<double> times;
    std::vector<Seg> segs;
    while (std::getline(std::cin, line)) {
        std::istringstream in(line);
        double first, step, r;
        in >> first >> step;
        std::vector<double> ranges;
        while (in >> r) ranges.push_back(r);
        std::vector<double> runs;
        for (int k = 0; k < 51; k++) {
            auto t = std::chrono::steady_clock::now();
            extract(first, step, ranges, segs);
            runs.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - t).count());
        }
        std::nth_element(runs.begin(), runs.begin() + 25, runs.end());
        times.push_back(runs[25]);
        for (auto& s : segs) std::printf("%.4f %.4f %.4f %.4f ", s.from.x, s.from.y, s.to.x, s.to.y);
        std::printf("\n");
    }
    if (times.empty()) return 1;
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    std::fprintf(stderr, "%.3f\n", times[times.size() / 2]);
}
