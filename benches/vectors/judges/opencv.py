"""OpenCV on what the extractor sees: a raster of a scan (LSD, HoughLinesP), contours of a picture.

python opencv.py scans.txt: each line first bearing, step (rad), then ranges in m; prints medians in µs.
python opencv.py --picture A.png B.png: the contours of a pair, by Canny and by a threshold, with approxPolyDP, in ms.
Needs opencv-python-headless. One thread, as the extractor has.
"""

import math
import statistics
import sys
import time

import cv2
import numpy as np

cv2.setNumThreads(1)
CELL = 0.05  # m


def timed(work, runs=15):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def scans(path):
    lsd, hough = [], []
    detector = cv2.createLineSegmentDetector()
    for line in open(path):
        first, step, *ranges = map(float, line.split())
        points = [
            (r * math.cos(first + step * k), r * math.sin(first + step * k))
            for k, r in enumerate(ranges)
            if 0.01 < r < 50
        ]
        if len(points) < 2:
            continue
        low = np.min(points, axis=0)
        cells = np.floor((np.array(points) - low) / CELL).astype(int) + 8
        raster = np.zeros((cells[:, 1].max() + 9, cells[:, 0].max() + 9), np.uint8)
        raster[cells[:, 1], cells[:, 0]] = 255
        lsd.append(timed(lambda: detector.detect(raster)))
        hough.append(timed(lambda: cv2.HoughLinesP(raster, 1, math.pi / 180, 8, None, 5, 10)))
    print(f"LSD {statistics.median(lsd) * 1e6:.0f} µs, HoughLinesP {statistics.median(hough) * 1e6:.0f} µs")


def pictures(paths):
    images = [cv2.imread(path, cv2.IMREAD_GRAYSCALE) for path in paths]

    def canny():
        for image in images:
            edges = cv2.Canny(image, 50, 150)
            found, _ = cv2.findContours(edges, cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
            [cv2.approxPolyDP(c, 1.2, True) for c in found]

    def level():
        for image in images:
            _, binary = cv2.threshold(image, 0, 255, cv2.THRESH_OTSU)
            found, _ = cv2.findContours(binary, cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
            [cv2.approxPolyDP(c, 1.2, True) for c in found]

    def paper():
        for image in images:
            cv2.HoughLinesP(cv2.Canny(image, 50, 150), 1, math.pi / 180, 40, None, 20, 5)

    for name, work in [("Canny, contours", canny), ("Otsu, contours", level), ("Canny, HoughLinesP", paper)]:
        print(f"{name}: {timed(work) * 1e3:.2f} ms")


if sys.argv[1] == "--picture":
    pictures(sys.argv[2:])
else:
    scans(sys.argv[1])
