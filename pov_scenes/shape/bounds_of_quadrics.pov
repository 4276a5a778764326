// The bounds of a quadric are tested if it is a hyperboloid of one sheet, a cone or has mixed terms, else only their box.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -12> look_at <0, 0.3, 0> angle 40 }
light_source { <5, 8, -9> 1 }
light_source { <-5, 8, -9> 0.3 }
plane { y, -2.2 pigment { checker rgb 1, rgb 0.7 } }
#default { pigment { rgb <1, 0.4, 0.3> } }
#declare Ball = sphere { 0, 1 }
quadric { <1, -1, 1>, 0, 0, -0.2 bounded_by { Ball } translate <-3.2, 1.6, 0> }
quadric { <-1, 1, 1>, 0, <0.2, 0, 0>, -0.2 bounded_by { box { -0.8, 0.8 } } rotate <20, 30, 40> translate <-1, 1.6, 0> }
quadric { <1, -1, 1>, 0, 0, 0 bounded_by { Ball } translate <1.2, 1.6, 0> }
quadric { <1, 1, 1>, <0.3, 0, 0.5>, 0, -1.7 bounded_by { Ball } rotate 30*z translate <3.3, 1.6, 0> }
quadric { <1, 0, 1>, 0, 0, -0.2 bounded_by { Ball } rotate <20, 30, 0> translate <-3.2, -1, 0> }
quadric { <-1, 1, -1>, 0, 0, -0.2 bounded_by { Ball } translate <-1, -1, 0> }
quadric { <1, -1, 1>, 0, 0, -0.2 clipped_by { box { -1.1, 1.1 } } bounded_by { Ball } translate <1.2, -1, 0> }
quadric { <1, 0, 1>, 0, <0, -1, 0>, -0.2 bounded_by { Ball } translate <3.3, -1, 0> }
