// A shape taken away from itself leaves its surface standing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 4, -9> look_at 0 angle 42 }
light_source { <4, 8, -6>, 1 }
background { rgb <.2, .3, .5> }
#macro Itself(Shape, X, Z)
  difference { object { Shape } object { Shape } rotate <10, 20, 5> translate <X, 0, Z> }
#end
union {
  Itself(box { -.7, .7 }, -2.4, 1.6)
  Itself(sphere { 0, .8 }, 0, 1.6)
  Itself(cylinder { -.7*y, .7*y, .7 }, 2.4, 1.6)
  Itself(cone { -.7*y, .8, .7*y, .3 }, -2.2, -1)
  Itself(torus { .6, .25 }, 0, -1)
  Itself(superellipsoid { <.5, .5> scale .7 }, 2.2, -1)
  pigment { rgb <1, .5, .2> }
}
