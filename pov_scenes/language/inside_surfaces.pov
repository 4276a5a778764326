// The distance from a surface up to which a point counts as inside: a square for each shape and distance, dark where it is not.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <8.5, 12, -10> look_at <8.5, 12, 0> right 33*x up 25*y }
light_source { <30, 40, -50> rgb 1 parallel point_at 0 }
#default { finish { ambient 0.5 diffuse 0.5 } }
#declare Row = 0;
// Squares at points from 10 tolerances inside to as many outside, in powers of two.
#macro Test(Shape, P, Outward, Tolerance)
  #for (I, -8, 8)
    #declare Off = select(I, -pow(2, -I - 5), 0, pow(2, I - 5))*1.1*Tolerance;
    box {
      <I + 8, Row, 0>, <I + 8.9, Row + 0.9, 1>
      pigment { rgb #if (inside(Shape, P + Off*Outward)) <1, 0.8, 0.4> #else <0.2, 0.3, 0.5> #end }
    }
  #end
  #declare Row = Row + 1;
#end
#declare Can = cylinder { 0, 2*y, 0.5 }
Test(Can, 0.1*x, -y, 2e-10)
Test(Can, <0.5, 1, 0>, x, 0.25e-10)
#declare Pipe = cylinder { 0, 2*y, 0.5 open scale <3, 7, 3> }
Test(Pipe, <0.3, 14, 0>, y, 14e-10)
#declare Stump = cone { 0, 0.25, 2*y, 0.5 }
Test(Stump, <0.1, 2, 0>, y, 4e-10)
Test(Stump, <0.375, 1, 0>, x, 0.333e-10)
Test(cone { 0, 0.5, 2*y, 0.500001 }, 0.1*x, -y, 2e-10)
#declare Funnel = cone { 0, 0.25, 2*y, 0.5 open }
Test(Funnel, <0.1, 2, 0>, y, 4e-10)
Test(plane { y, 0.3 rotate 30*x scale 10 }, 2*sqrt(3)*y, y, 1.1547e-10)
Test(superellipsoid { <0.5, 0.25> }, z, z, 1e-10)
Test(superellipsoid { <2, 0.1> scale 10 }, 10*x, x, 10e-10)
#declare Sausage = sphere_sweep { linear_spline 2, -2*x, 0.5, 2*x, 0.5 }
Test(Sausage, 0.5*y, y, 4e-10)
Test(Sausage, 2.5*x, x, 1e-10)
Test(sphere_sweep { linear_spline 2, -2*x, 0.5, 2*x, 1.5 }, <-0.25, sqrt(15/16), 0>, <-0.25, sqrt(15/16), 0>, 1.875e-10)
Test(blob { threshold 0.5 sphere { 0, 1, 1 } }, x*sqrt(1 - sqrt(0.5)), x, 6532e-10)
Test(quartic { <1,0,0,0,2,0,0,2,0,-2.5,0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,1.5,0,0,0,0,1,0,-2.5,0,0.5625> }, 1.5*x, x, 4167e-10)
Test(poly { 2, <1,0,0,0,1,0,0,1,0,-1> scale 10 }, 10*x, x, 5e-4)
#declare Bar = prism { 0, 1, 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> }
Test(Bar, <1, 0.5, 0.3>, x, 1)
Test(Bar, <-1, 0.5, 0.3>, -x, 1)
Test(Bar, <0.3, 0.5, -1>, -z, 1)
Test(prism { 0, 1, 5, <-1, 0>, <0, -1>, <1, 0>, <0, 1>, <-1, 0> }, 0.5*y, z, 0.2)
Test(prism { conic_sweep 0, 1, 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> }, 2e-10*y, -y, 1e-10)
#declare Ring = lathe { 5, <2, 0>, <3, 0>, <3, 1>, <2, 1>, <2, 0> }
Test(Ring, 2.5*x, -y, 0.2)
Test(Ring, <2, 0.5, 0>, x, 0.2)
Test(lathe { 3, <0.5, 0>, <1, 0.5>, <0.5, 1> }, <0.7, 0.5, 0>, y, 0.2)
