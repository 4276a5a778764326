// The box of a sphere sweep: that of its spheres, which are moved, turned and scaled evenly one by one, until a transform
// is uneven. A bound that is smaller than another box but larger than this one has no effect.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -20> right 16*x up 12*y look_at 0 }
light_source { <50, 90, -90> 1 }
light_source { <-50, 90, -90> 0.3 }
#declare Linear = sphere_sweep { linear_spline 2 <-2, -1, 0>, 0.5, <2, 1, 0>, 0.3 }
#declare Cubic = sphere_sweep { cubic_spline 5 <-3, -1, 0>, 0.5, <-2, 1, 0>, 0.3, <0, 0, 1>, 0.4, <2, 1, 0>, 0.5, <3, 0, 0>, 0.1 }
#declare B = sphere_sweep { b_spline 5 <-3, -1, 0>, 0.5, <-2, 1, 0>, 0.3, <0, 0, 1>, 0.4, <2, 1, 0>, 0.5, <3, 0, 0>, 0.1 }
#macro Boxed(Object, To)
  box { min_extent(Object), max_extent(Object) scale 0.6 pigment { rgb <0.3, 0.6, 0.9> } translate To }
#end
Boxed(object { Linear rotate <20, 30, 40> }, <-6, 3.8, 0>)
Boxed(object { Linear scale 0.8 rotate <20, 30, 40> translate x rotate 30*z }, <-3, 3.8, 0>)
Boxed(object { Linear rotate <20, 30, 40> scale <1, 2, 1> }, <0, 3.8, 0>)
Boxed(object { Linear scale <1, 2, 1> rotate <20, 30, 40> }, <3, 3.8, 0>)
Boxed(object { Linear matrix <1, 0, 0, 0.5, 1, 0, 0, 0, 1, 0, 0, 0> rotate 50*z }, <6, 3.8, 0>)
Boxed(object { Cubic rotate <20, 30, 40> scale 0.6 }, <-5, 0.4, 0>)
Boxed(object { B rotate <20, 30, 40> }, <-1, 0.4, 0>)
Boxed(object { B rotate <20, 30, 40> scale <0.5, 0.5, -0.5> }, <3, 0.4, 0>)
object { Linear bounded_by { box { -1, 1 } } rotate <20, 30, 40> pigment { rgb <1, 0.4, 0.2> } translate <-5, -3.8, 0> }
object { Linear rotate <20, 30, 40> bounded_by { box { -1, 1 } } pigment { rgb <1, 0.4, 0.2> } translate <0, -3.8, 0> }
object { Linear bounded_by { box { -1, 1 } } scale 0.8 pigment { rgb <1, 0.4, 0.2> } translate <5, -3.8, 0> }
