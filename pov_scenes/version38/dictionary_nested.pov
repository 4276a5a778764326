// Dictionaries hold dictionaries and arrays, and arrays hold dictionaries.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary { .Inner: dictionary { .Size: 0.7 }, .List: array[2] { 0.3, 0.5 } }
#declare D.Inner.Place = <-2, 0, 0>;
#declare A = array[2] { dictionary { .Size: 0.6 }, dictionary { .Size: 0.9 } }
#declare A[0].Size = 0.4;
sphere { D.Inner.Place, D.Inner.Size pigment { rgb <1, 0.5, 0.2> } }
sphere { 0, D.List[1] }
sphere { <1.5, 0, 0>, A[0].Size }
sphere { <2.8, 0, 0>, A[1].Size * 0.5 }
