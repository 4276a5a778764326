// mistakes in lines 2, 3: rand without a stream
#declare A = rand();
#declare B = rand(1);
