// A board of squares flush with their frame, and unbounded shapes with bounded_by: POV-Ray's boxes of these decide how its
// tree is divided, and so which of the flush faces shows where.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { location <-8, 4, -14> angle 40 look_at <-2, 0, -4> }
light_source { <100, 400, -600>, 1 }
#declare Fours = union {
  box { -1, 1 translate <-1, -1, 1> pigment { rgb <1, 0.3, 0.2> } }
  box { -1, 1 translate <1, -1, -1> pigment { rgb <0.2, 0.8, 0.3> } }
}
#declare Eights = union {
  object { Fours translate <-2, 0, 2> }
  object { Fours translate <2, 0, 2> }
  object { Fours translate <-2, 0, -2> }
  object { Fours translate <2, 0, -2> }
}
union {
  object { Eights translate <-4, 0, 4> }
  object { Eights translate <4, 0, 4> }
  object { Eights translate <-4, 0, -4> }
  object { Eights translate <4, 0, -4> }
  box { <-8, -0.5, -8>, <8, 0, 8> }
  pigment { rgb <0.3, 0.4, 1> }
}
#declare Figure = union {
  quartic {
    <1, 0, 0, 0, 2, 0, 0, 2, 0, -132.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 123.5, 0, 0, 0, 0, 1, 0, -132.5, 0,
    3813.0625>
    sturm
    translate -11.2468*y
  }
  sphere { 17.7*y, 7 }
  bounded_by { cylinder { -26*y, 26*y, 14 } }
  translate 18.7468*y
  scale 0.06
  pigment { rgb 1 }
}
object { Figure rotate 60*y translate <-5, 0, -7> }
object { Figure rotate 30*y translate <1, 0, -1> }
sphere { 0, 1000 inverse hollow pigment { rgb 0.6 } }
