// Measures ray casting by Embree 3 at spheres, without shading.
//
//   g++ -O3 -march=native embree_spheres.cpp -o embree_spheres -lembree3
//   ./embree_spheres FILE WIDTH HEIGHT
//
// FILE has lines written by tools/bench:
//
//   camera Z DISTANCE RIGHT     a camera at (0, 0, Z) that looks along z, its picture plane RIGHT wide and 1 high
//   light X Y Z
//   ball X Y Z RADIUS
//
// One thread casts a ray through the middle of each pixel and, where it hits a sphere, a shadow ray to each light that
// the point faces: in packets of 16, a block of 4x4 pixels each, in single precision. Prints the processor seconds of
// building the BVH and of casting, and the number of rays.

#include <embree3/rtcore.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <pmmintrin.h>
#include <vector>
#include <xmmintrin.h>

namespace {

constexpr int SIDE = 4;
constexpr int PACKET = SIDE * SIDE;

// Start of a shadow ray, as a fraction of its length, against self-intersection: a millimetre in 100 metres.
constexpr float CLEAR_OF_THE_START = 1e-5f;

struct Point {
  float x, y, z;
};

// The layout of Embree's buffer.
struct Sphere {
  Point centre;
  float radius;
};

struct Input {
  float camera = 0, distance = 1, right = 1;
  std::vector<Point> lights;
  std::vector<Sphere> spheres;
};

struct Counts {
  long primary = 0, hits = 0, shadow = 0, occluded = 0;
};

bool read(const char *name, Input &input) {
  FILE *file = std::fopen(name, "r");
  if (!file) return false;
  char line[256];
  bool understood = true;
  while (understood && std::fgets(line, sizeof line, file)) {
    Point p;
    float radius;
    if (std::sscanf(line, "ball %f %f %f %f", &p.x, &p.y, &p.z, &radius) == 4)
      input.spheres.push_back({p, radius});
    else if (std::sscanf(line, "light %f %f %f", &p.x, &p.y, &p.z) == 3)
      input.lights.push_back(p);
    else
      understood = std::sscanf(line, "camera %f %f %f", &input.camera, &input.distance, &input.right) == 3;
  }
  std::fclose(file);
  return understood;
}

// Processor seconds of this process, with the threads that may help to build the BVH.
double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

RTCScene scene_of(RTCDevice device, const std::vector<Sphere> &spheres) {
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  void *buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Sphere), spheres.size());
  std::memcpy(buffer, spheres.data(), spheres.size() * sizeof(Sphere));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

class Caster {
public:
  Caster(const Input &input, RTCScene scene, int width, int height)
      : input(input), scene(scene), width(width), height(height) {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  Counts cast() {
    for (int top = 0; top < height; top += SIDE)
      for (int left = 0; left < width; left += SIDE) block(left, top);
    return counts;
  }

private:
  void block(int left, int top) {
    alignas(64) RTCRayHit16 rays = {};
    alignas(64) int valid[PACKET];
    for (int i = 0; i < PACKET; i++) {
      const int x = left + i % SIDE, y = top + i / SIDE;
      valid[i] = x < width && y < height ? -1 : 0;
      counts.primary += valid[i] != 0;
      const float across = ((x + 0.5f) / width - 0.5f) * input.right;
      const float up = 0.5f - (y + 0.5f) / height;
      const float shorter = 1 / std::sqrt(across * across + up * up + input.distance * input.distance);
      rays.ray.org_z[i] = input.camera;
      rays.ray.dir_x[i] = across * shorter;
      rays.ray.dir_y[i] = up * shorter;
      rays.ray.dir_z[i] = input.distance * shorter;
      rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
      rays.ray.mask[i] = ~0u;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene, &context, &rays);
    Point points[PACKET];
    bool hit[PACKET];
    for (int i = 0; i < PACKET; i++) {
      hit[i] = valid[i] && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      counts.hits += hit[i];
      // Inactive rays must be valid as well.
      const float t = hit[i] ? rays.ray.tfar[i] : 0;
      points[i] = {rays.ray.dir_x[i] * t, rays.ray.dir_y[i] * t, input.camera + rays.ray.dir_z[i] * t};
    }
    for (const Point &light : input.lights) to_light(light, points, hit, rays.hit);
  }

  void to_light(const Point &light, const Point (&points)[PACKET], const bool (&hit)[PACKET], const RTCHit16 &hits) {
    alignas(64) RTCRay16 rays = {};
    alignas(64) int valid[PACKET];
    long active = 0;
    for (int i = 0; i < PACKET; i++) {
      const Point &from = points[i];
      const Point direction = {light.x - from.x, light.y - from.y, light.z - from.z};
      const bool faces = direction.x * hits.Ng_x[i] + direction.y * hits.Ng_y[i] + direction.z * hits.Ng_z[i] > 0;
      valid[i] = hit[i] && faces ? -1 : 0;
      active += valid[i] != 0;
      rays.org_x[i] = from.x, rays.org_y[i] = from.y, rays.org_z[i] = from.z;
      rays.dir_x[i] = direction.x, rays.dir_y[i] = direction.y, rays.dir_z[i] = direction.z;
      rays.tnear[i] = CLEAR_OF_THE_START;
      rays.tfar[i] = 1;
      rays.mask[i] = ~0u;
    }
    if (active == 0) return;
    counts.shadow += active;
    rtcOccluded16(valid, scene, &context, &rays);
    // Embree sets the end of a ray that hits something to minus infinity.
    for (int i = 0; i < PACKET; i++) counts.occluded += valid[i] && rays.tfar[i] < 0;
  }

  const Input &input;
  RTCScene scene;
  const int width, height;
  RTCIntersectContext context;
  Counts counts;
};

}  // namespace

int main(int argc, char **argv) {
  Input input;
  const int width = argc == 4 ? std::atoi(argv[2]) : 0, height = argc == 4 ? std::atoi(argv[3]) : 0;
  if (width <= 0 || height <= 0 || !read(argv[1], input)) {
    std::fprintf(stderr, "embree_spheres FILE WIDTH HEIGHT: the file is a list of `camera`, `light` and `ball`\n");
    return 1;
  }
  // Embree's manual recommends flushing denormal numbers to zero.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);

  RTCDevice device = rtcNewDevice("threads=1");
  const double start = processor_seconds();
  RTCScene scene = scene_of(device, input.spheres);
  const double built = processor_seconds();
  const Counts counts = Caster(input, scene, width, height).cast();
  const double cast = processor_seconds();
  std::printf("build %.6f\ncast %.6f\n", built - start, cast - built);
  std::printf("primary %ld\nhits %ld\n", counts.primary, counts.hits);
  std::printf("shadow %ld\noccluded %ld\n", counts.shadow, counts.occluded);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
