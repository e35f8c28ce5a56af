#include "viewer/sphere.h"

#include <cmath>
#include <numbers>
#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/LOD>

namespace divot::viewer {
namespace {

// `sectors` around the axis and half as many from pole to pole. As GL_QUADS its edges can be drawn without diagonals.
osg::ref_ptr<osg::Geometry> make_globe(unsigned sectors, GLenum mode) {
  const unsigned rings = sectors / 2;
  osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
  for (unsigned ring = 0; ring <= rings; ++ring) {
    const double polar = std::numbers::pi * ring / rings;
    for (unsigned sector = 0; sector <= sectors; ++sector) {
      const double around = 2 * std::numbers::pi * sector / sectors;
      points->push_back(
          osg::Vec3d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)));
    }
  }

  osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(mode);
  for (unsigned ring = 0; ring < rings; ++ring) {
    for (unsigned sector = 0; sector < sectors; ++sector) {
      const unsigned a = ring * (sectors + 1) + sector, below = a + sectors + 1;
      if (mode == GL_QUADS) {
        for (const unsigned i : {a, below, below + 1, a + 1}) indices->push_back(i);
      } else {
        for (const unsigned i : {a, below, below + 1, a, below + 1, a + 1}) indices->push_back(i);
      }
    }
  }

  osg::ref_ptr<osg::Geometry> globe = new osg::Geometry;
  globe->setUseDisplayList(false);
  globe->setUseVertexBufferObjects(true);
  globe->setVertexArray(points);
  globe->setNormalArray(points, osg::Array::BIND_PER_VERTEX);
  globe->addPrimitiveSet(indices);
  if (mode == GL_TRIANGLES) globe->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
  return globe;
}

}  // namespace

osg::ref_ptr<osg::Node> make_sphere() {
  osg::ref_ptr<osg::LOD> levels = new osg::LOD;
  levels->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
  // Edges stay within a fifth of a pixel of a circle. The size on the screen is twice the diameter.
  levels->addChild(make_globe(12, GL_TRIANGLES), 0, 24);
  levels->addChild(make_globe(32, GL_TRIANGLES), 24, 180);
  levels->addChild(make_globe(64, GL_TRIANGLES), 180, 800);
  levels->addChild(make_globe(128, GL_TRIANGLES), 800, 1e9f);
  return levels;
}

osg::ref_ptr<osg::Node> make_line_sphere() { return make_globe(24, GL_QUADS); }

}  // namespace divot::viewer
