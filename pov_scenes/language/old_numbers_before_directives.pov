// Before 3.5 a declared number, vector or colour ends where a directive follows, without a semicolon.
#version 3.1
camera { location <0, 1, -5> look_at 0 }
light_source { <-3, 5, -6>, 1 }
#declare Count = 1
#declare Size = Count * 0.4
#declare Red = <1, 0.5, 0.2>
#if (Count = 1)
  #declare Place = -x * 2
  #while (Count < 5)
    sphere { Place, Size * 0.8 + Count / 20 pigment { rgb Red / Count } }
    #declare Place = Place + x
    #declare Count = Count + 1
  #end
#end
