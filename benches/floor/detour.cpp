// Recast and Detour themselves on a floor that `cargo bench --bench floor -- --write NAME FILE` wrote.
//
//   g++ -O3 -I/usr/include/recastnavigation benches/floor/detour.cpp -lRecast -lDetour -o detour && ./detour FILE
//
// Prints lines of numbers as the bench's own programs do: times of building in ms, MB held, ways with their µs and cm.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <DetourNavMeshQuery.h>
#include <Recast.h>

// The settings of Recast's demonstration, as in peers.rs.
const float CELL = 0.05f;
const int RADIUS = 4, HEIGHT = 24, CLIMB = 0;
// Beyond this many cells a floor is built in tiles.
const float LARGEST = 2600.0f;
const int TILE = 512;

struct Floor {
    std::vector<float> corners, ways;
    float low[3], high[3];
};

std::vector<float> take(FILE *file, size_t points) {
    uint32_t count = 0;
    if (fread(&count, 4, 1, file) != 1) exit(2);
    std::vector<float> numbers(count * points * 3);
    if (fread(numbers.data(), 4, numbers.size(), file) != numbers.size()) exit(2);
    return numbers;
}

double held(const char *key) {
    FILE *status = fopen("/proc/self/status", "r");
    char line[256];
    double kilobytes = NAN;
    while (fgets(line, sizeof line, status))
        if (!strncmp(line, key, strlen(key))) kilobytes = atof(line + strlen(key));
    fclose(status);
    return kilobytes / 1024;
}

// What Detour takes of one tile; null where there is no floor.
unsigned char *tile(const std::vector<float> &corners, const float *low, const float *high, int border, int column,
                    int row, int *size) {
    rcContext context(false);
    int width = 0, depth = 0;
    rcCalcGridSize(low, high, CELL, &width, &depth);
    int count = int(corners.size() / 9);
    std::vector<int> numbers(corners.size() / 3);
    for (size_t i = 0; i < numbers.size(); i++) numbers[i] = int(i);
    std::vector<unsigned char> kinds(count, 0);
    rcMarkWalkableTriangles(&context, 45, corners.data(), int(numbers.size()), numbers.data(), count, kinds.data());
    rcHeightfield *field = rcAllocHeightfield();
    rcCreateHeightfield(&context, *field, width, depth, low, high, CELL, CELL);
    rcRasterizeTriangles(&context, corners.data(), int(numbers.size()), numbers.data(), kinds.data(), count, *field, CLIMB);
    rcFilterLowHangingWalkableObstacles(&context, CLIMB, *field);
    rcFilterLedgeSpans(&context, HEIGHT, CLIMB, *field);
    rcFilterWalkableLowHeightSpans(&context, HEIGHT, *field);
    rcCompactHeightfield *compact = rcAllocCompactHeightfield();
    rcBuildCompactHeightfield(&context, HEIGHT, CLIMB, *field, *compact);
    rcFreeHeightField(field);
    rcErodeWalkableArea(&context, RADIUS, *compact);
    rcBuildDistanceField(&context, *compact);
    rcBuildRegions(&context, *compact, border, 64, 400);
    rcContourSet *contours = rcAllocContourSet();
    rcBuildContours(&context, *compact, 1.3f, RADIUS * 8, *contours);
    rcPolyMesh *mesh = rcAllocPolyMesh();
    rcBuildPolyMesh(&context, *contours, 6, *mesh);
    rcPolyMeshDetail *detail = rcAllocPolyMeshDetail();
    rcBuildPolyMeshDetail(&context, *mesh, *compact, 6 * CELL, CELL, *detail);
    rcFreeCompactHeightfield(compact);
    rcFreeContourSet(contours);
    for (int i = 0; i < mesh->npolys; i++) mesh->flags[i] = 1;
    dtNavMeshCreateParams made = {};
    made.verts = mesh->verts, made.vertCount = mesh->nverts;
    made.polys = mesh->polys, made.polyAreas = mesh->areas, made.polyFlags = mesh->flags;
    made.polyCount = mesh->npolys, made.nvp = mesh->nvp;
    made.detailMeshes = detail->meshes, made.detailVerts = detail->verts, made.detailVertsCount = detail->nverts;
    made.detailTris = detail->tris, made.detailTriCount = detail->ntris;
    made.walkableHeight = HEIGHT * CELL, made.walkableRadius = RADIUS * CELL, made.walkableClimb = CLIMB * CELL;
    made.tileX = column, made.tileY = row, made.cs = CELL, made.ch = CELL, made.buildBvTree = true;
    rcVcopy(made.bmin, mesh->bmin);
    rcVcopy(made.bmax, mesh->bmax);
    unsigned char *data = nullptr;
    if (!dtCreateNavMeshData(&made, &data, size)) data = nullptr;
    rcFreePolyMesh(mesh);
    rcFreePolyMeshDetail(detail);
    return data;
}

dtNavMesh *build(const Floor &floor) {
    dtNavMesh *mesh = dtAllocNavMesh();
    int size = 0;
    if (std::max(floor.high[0] - floor.low[0], floor.high[2] - floor.low[2]) / CELL <= LARGEST) {
        unsigned char *data = tile(floor.corners, floor.low, floor.high, 0, 0, 0, &size);
        mesh->init(data, size, DT_TILE_FREE_DATA);
        return mesh;
    }
    const float step = TILE * CELL;
    const int border = RADIUS + 3;
    const float pad = border * CELL;
    const int columns = int(ceil((floor.high[0] - floor.low[0]) / step));
    const int rows = int(ceil((floor.high[2] - floor.low[2]) / step));
    dtNavMeshParams parameters = {};
    rcVcopy(parameters.orig, floor.low);
    parameters.tileWidth = parameters.tileHeight = step;
    parameters.maxTiles = columns * rows;
    parameters.maxPolys = 1 << 12;
    mesh->init(&parameters);
    // Each tile is given the triangles that reach into it.
    std::vector<std::vector<float>> by_tile(columns * rows);
    for (size_t i = 0; i < floor.corners.size(); i += 9) {
        const float *t = &floor.corners[i];
        int span[2][2];
        for (int axis : {0, 2}) {
            float least = std::min({t[axis], t[3 + axis], t[6 + axis]});
            float most = std::max({t[axis], t[3 + axis], t[6 + axis]});
            int last = (axis ? rows : columns) - 1;
            span[axis / 2][0] = std::clamp(int((least - pad - floor.low[axis]) / step), 0, last);
            span[axis / 2][1] = std::clamp(int((most + pad - floor.low[axis]) / step), 0, last);
        }
        for (int row = span[1][0]; row <= span[1][1]; row++)
            for (int column = span[0][0]; column <= span[0][1]; column++)
                by_tile[row * columns + column].insert(by_tile[row * columns + column].end(), t, t + 9);
    }
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            float from[2] = {floor.low[0] + column * step, floor.low[2] + row * step};
            float low[3] = {from[0] - pad, floor.low[1], from[1] - pad};
            float high[3] = {from[0] + step + pad, floor.high[1], from[1] + step + pad};
            unsigned char *data = tile(by_tile[row * columns + column], low, high, border, column, row, &size);
            if (data && dtStatusFailed(mesh->addTile(data, size, DT_TILE_FREE_DATA, 0, nullptr))) dtFree(data);
        }
    return mesh;
}

int polygons(const dtNavMesh &mesh) {
    int count = 0;
    for (int i = 0; i < mesh.getMaxTiles(); i++)
        if (mesh.getTile(i)->header) count += mesh.getTile(i)->header->polyCount;
    return count;
}

// Nearest polygons, corridor, taut way: what it takes to be told a way. Its length in cm, negative if there is none.
double ask(const dtNavMeshQuery &query, const float *from, const float *to) {
    static const int MOST = 8192;
    static dtPolyRef corridor[MOST], at[MOST];
    static float taut[3 * MOST];
    static unsigned char flags[MOST];
    static const dtQueryFilter all;
    static const float reach[3] = {1, 1, 1};
    dtPolyRef start = 0, goal = 0;
    float first[3], last[3];
    query.findNearestPoly(from, reach, &all, &start, first);
    query.findNearestPoly(to, reach, &all, &goal, last);
    int count = 0;
    if (!start || !goal) return -1;
    query.findPath(start, goal, first, last, &all, corridor, &count, MOST);
    if (count == 0 || corridor[count - 1] != goal) return -1;
    query.findStraightPath(first, last, corridor, count, taut, flags, at, &count, MOST);
    double length = 0;
    for (int i = 1; i < count; i++)
        length += 100 * hypot(taut[3 * i] - taut[3 * i - 3], taut[3 * i + 2] - taut[3 * i - 1]);
    return length;
}

int main(int, char **arguments) {
    FILE *file = fopen(arguments[1], "rb");
    if (!file) return 2;
    Floor floor;
    floor.corners = take(file, 3);
    floor.ways = take(file, 2);
    fclose(file);
    rcCalcBounds(floor.corners.data(), int(floor.corners.size() / 3), floor.low, floor.high);
    floor.low[1] = -0.1f, floor.high[1] = 3.1f;

    printf("before\t%f\n", held("VmRSS:"));
    dtNavMesh *mesh = build(floor);
    double after = held("VmRSS:");
    printf("after\t%f\npeak\t%f\n", after, held("VmHWM:"));
    dtNavMesh *second = build(floor);
    printf("kept\t%f\n", held("VmRSS:") - after);
    dtFreeNavMesh(second);
    printf("cells\t%d\n", polygons(*mesh));

    typedef std::chrono::steady_clock Watch;
    std::vector<double> spent, passed;
    const int times = floor.corners.size() > 1000000 ? 3 : floor.corners.size() > 100000 ? 7 : 41;
    for (int i = 0; i < times; i++) {
        clock_t start = clock();
        Watch::time_point began = Watch::now();
        dtNavMesh *made = build(floor);
        spent.push_back(1e3 * double(clock() - start) / CLOCKS_PER_SEC);
        passed.push_back(std::chrono::duration<double, std::milli>(Watch::now() - began).count());
        dtFreeNavMesh(made);
    }
    std::sort(spent.begin(), spent.end());
    std::sort(passed.begin(), passed.end());
    printf("build\t%f\nclock\t%f\n", spent[times / 2], passed[times / 2]);

    dtNavMeshQuery query;
    query.init(mesh, 65535);
    for (size_t i = 0; i < floor.ways.size() / 6; i++) {
        const float *way = &floor.ways[6 * i];
        double best = INFINITY, length = -1;
        for (int k = 0; k < 5; k++) {
            Watch::time_point start = Watch::now();
            length = ask(query, way, way + 3);
            best = std::min(best, std::chrono::duration<double, std::micro>(Watch::now() - start).count());
        }
        if (length >= 0) printf("way\t%zu\t%f\t%f\n", i, best, length);
    }
}
