// The last digits of extents: POV-Ray keeps boxes in single precision and computes with them in double precision.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <8, 3, -10> right 16*x up 6*y }
#declare Column = 0;
#macro Digit(Value, Row)
  #local Steps = mod(abs(Value) * pow(2, 24), 64);
  box { <Column, Row, 0>, <Column + .9, Row + .9, 1> pigment { rgb <Steps, mod(Steps, 8) * 8, mod(Steps, 2) * 32> / 64 } finish { ambient 1 diffuse 0 } }
#end
#macro Digits(Thing)
  #local A = min_extent(Thing);
  #local B = max_extent(Thing);
  Digit(A.x, 0) Digit(A.y, 1) Digit(A.z, 2) Digit(B.x, 3) Digit(B.y, 4) Digit(B.z, 5)
  #declare Column = Column + 1;
#end
#declare Ball = sphere { <.1, .2, .3>, .77 };
Digits(intersection { box { <-.31, -.42, -.53>, <.71, .61, .51> } object { Ball } translate <.37, .83, -.29> })
Digits(union { object { Ball } box { -.3, .41 rotate 20*y } rotate <10, 20, 30> })
Digits(difference { object { Ball } plane { y, .13 } scale <.7, 1.3, .9> rotate 33*x })
Digits(sphere { <.1, .2, .3>, .77 scale <1, .5, .3> rotate <10, 20, 30> })
Digits(box { -.1, .7 rotate <15, 25, 35> })
Digits(cone { <.1, .3, -.2>, 1.1, <.4, 1.3, .2>, .3 })
Digits(cone { .1*y, .2, 1.3*y, .9 rotate 40*z })
Digits(cylinder { <.1, .3, -.2>, <.4, 1.3, .2>, .3 })
Digits(torus { .9, .23 translate <.37, .83, -.29> })
Digits(torus { .9, .23 rotate <10, 20, 30> })
Digits(prism { -.13, .71, 4, <-.8, .1>, <.8, .17>, <.3, 1.4>, <-.8, .1> rotate <10, 20, 30> translate .3 })
Digits(lathe { linear_spline 3, <.1, .3>, <.77, .4>, <.2, 1.1> translate <.37, .83, -.29> })
Digits(sor { 4, <.1, -.5>, <.3, 0>, <.77, .7>, <.2, 1.1> rotate 20*x translate .1 })
Digits(height_field { function 9, 9 { x * y } water_level .3 rotate 20*x translate .1 })
Digits(mesh { triangle { <-.1, .2, .3>, <.9, .7, -.4>, <.2, 1.3, .8> } scale 1.3 rotate <10, 20, 30> translate .1 })
Digits(superellipsoid { <.3, .6> scale .77 rotate <10, 20, 30> })
